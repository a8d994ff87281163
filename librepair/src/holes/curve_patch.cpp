// SPDX-License-Identifier: MIT
// A flat patch over a hole in something round is a facet that was not there. So the patch gets new
// points (refine_patch.h), which are then placed where the sum of squared bending is least, the
// triangles around the rim held: one sparse linear system, L^T A^-1 L x = b, with the cotangent
// Laplacian L (P. Liepa, Filling holes in meshes, 2003; M. Botsch and L. Kobbelt, An intuitive
// framework for real-time freeform modeling, 2004).
//
// Least bending makes caps too flat, so a second solution evens out the mean curvature instead. It
// is taken where it leaves the rim about as smoothly. A solution that went astray, or leaves the
// rim more steeply than the flat patch, is none: the flat patch stays, which is always there.
#include "curve_patch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/SparseCholesky>

#include <base/angles.h>

#include "rim_plane.h"

namespace meshrepair::internal {
namespace {

// Shorter rims leave too little room for a difference.
constexpr std::size_t kShortestRim = 12;

// Of bending: the work grows faster than the number of points.
constexpr std::size_t kMostPoints = 10'000;

// Mean angles between the surface and the flat patch, in radians. Below the first nothing is to be
// gained; above the second the surface ends there, and something else is missing.
constexpr double kStraight = 0.02;
constexpr double kSteep = 1.2;

// A rim in one plane at which the surface bends by more than this is a cut, or the edge of a face.
constexpr double kSteepAtPlane = 0.3;
constexpr double kPlanar = 1e-3;  // of the rim's extent

// The same for a ragged cut: the mean angle to the plane of a rim that lies in it but for so much.
constexpr double kSteepAtCut = 1.0;
constexpr double kNearlyPlanar = 0.05;

// Solutions with the weights of the shape at hand: the rounds of least bending, and at most those
// of even bending, which end where no point moves by more than a share of the rim's extent.
constexpr int kLeastRounds = 2;
constexpr int kEvenRounds = 6;
constexpr double kSettled = 1e-3;

// The share of L x along the surface that even bending leaves as it is. With less the points of
// large patches slide from round to round; with all of it patches keep the noise of their rims.
constexpr double kHeld = 0.8;

// Even bending is not to leave the rim more steeply than least bending, or hardly.
constexpr double kAsSteep = 1.05;

using Sparse = Eigen::SparseMatrix<double>;
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3>;

double extent_of(const std::vector<Vec3d>& points) {
  Vec3d low = points.front(), high = low;
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

// Between the surface and a patch, weighted by the lengths of the rim's edges.
double mean_bend(const Rim& rim, const std::vector<Vec3d>& points,
                 const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double sum = 0, length = 0;
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a >= rim.size() || (a + 1) % rim.size() != b) continue;
      const Vec3d& third = points[t[(k + 2) % 3]];
      const double cosine = fold_cosine(points[a], points[b], rim.apex[a], third);
      // The angle of a needle says nothing.
      const double edge = (points[b] - points[a]).norm();
      const double height = 2 * triangle_area(points[a], points[b], third) / edge;
      const double weight = std::min(edge, height);
      sum += weight * arc_cosine(std::clamp(-cosine, -1.0, 1.0));
      length += weight;
    }
  }
  return length > 0 ? sum / length : 0;
}

bool goes_on_curved(const Rim& rim, const LoopTriangulation& flat, bool from_cuts) {
  if (rim.size() < kShortestRim) return false;
  const double bend = mean_bend(rim, rim.points, flat.triangles);
  if (bend < kStraight || bend > kSteep) return false;
  const RimPlane plane = plane_of(rim);
  const double extent = extent_of(rim.points);
  if (plane.farthest <= kPlanar * extent) return bend <= kSteepAtPlane;
  if (from_cuts || plane.mean_distance > kNearlyPlanar * extent) return true;
  return mean_angle(rim, plane) <= kSteepAtCut;
}

// Solves for the new points: they minimise the sum over all points of the rim and the patch of
// |L x - b|^2 / area, L the cotangent Laplacian of the patch and the collar. b is 0 for least
// bending. That makes caps of a sphere too flat, the more the larger they are; with even bending
// spheres, cylinders and planes stay what they are: b has the part h s along the normal of the
// shape at hand, s the point's share of the area and h, twice the mean curvature, the one number
// that fits this shape best.
class Bending {
 public:
  enum class Kind { least, even };

  Bending(PatchMesh& patch, const Rim& rim, const Collar& collar)
      : patch_(patch),
        rim_(static_cast<Eigen::Index>(rim.size())),
        inner_(static_cast<Eigen::Index>(patch.points.size())),
        triangles_(patch.triangles),
        points_(patch.points) {
    points_.insert(points_.end(), collar.points.begin(), collar.points.end());
    const auto shift = static_cast<std::uint32_t>(inner_ - rim_);
    for (auto t : collar.triangles) {
      for (std::uint32_t& p : t) p += static_cast<Eigen::Index>(p) < rim_ ? 0 : shift;
      triangles_.push_back(t);
    }
  }

  // With weights of the shape at hand; false where that gives no numbers.
  bool solve(Kind kind) {
    const Sparse laplacian = weighted_laplacian();
    const Sparse moving = laplacian.middleCols(rim_, inner_ - rim_);
    Positions fixed(laplacian.cols(), 3);
    for (Eigen::Index i = 0; i < fixed.rows(); ++i) {
      const bool is_moving = i >= rim_ && i < inner_;
      fixed.row(i) = is_moving ? Vec3d::Zero() : points_[static_cast<std::size_t>(i)];
    }
    Positions wanted = -(laplacian * fixed);
    if (kind == Kind::even) wanted += even_bend(laplacian);
    const Sparse system = moving.transpose() * moving;
    const Positions right = moving.transpose() * wanted;
    Eigen::SimplicialLDLT<Sparse> solver(system);
    if (solver.info() != Eigen::Success) return false;
    const Positions solution = solver.solve(right);
    if (solver.info() != Eigen::Success || !solution.allFinite()) return false;
    farthest_ = 0;
    for (Eigen::Index i = rim_; i < inner_; ++i) {
      const Vec3d at = solution.row(i - rim_);
      farthest_ = std::max(farthest_, (at - points_[static_cast<std::size_t>(i)]).norm());
      points_[static_cast<std::size_t>(i)] = at;
      patch_.points[static_cast<std::size_t>(i)] = at;
    }
    return true;
  }

  // That a point went in the last solution.
  [[nodiscard]] double farthest_move() const { return farthest_; }

 private:
  // The part of L x along each normal is to be h s, which on a sphere holds for all points and any
  // weights. What lies along the surface comes from the mesh, not the shape.
  [[nodiscard]] Positions even_bend(const Sparse& laplacian) const {
    Positions at(laplacian.cols(), 3);
    for (Eigen::Index i = 0; i < at.rows(); ++i) at.row(i) = points_[static_cast<std::size_t>(i)];
    Eigen::VectorXd share = Eigen::VectorXd::Zero(inner_);
    for (Eigen::Index column = 0; column < laplacian.outerSize(); ++column) {
      for (Sparse::InnerIterator entry(laplacian, column); entry; ++entry) {
        const double length2 = (at.row(entry.row()) - at.row(column)).squaredNorm();
        share[entry.row()] += 0.25 * entry.value() * length2;
      }
    }
    const Positions normal = normals(), bend = laplacian * at;
    const Eigen::VectorXd along = bend.cwiseProduct(normal).rowwise().sum();
    const double even = along.dot(share) / std::max(share.squaredNorm(), 1e-300);
    return kHeld * bend + (even * share - kHeld * along).asDiagonal() * normal;
  }

  // Of the rim and the patch. The surface may run either way round: its triangles are turned as
  // those of the patch at each point.
  [[nodiscard]] Positions normals() const {
    Positions sum = Positions::Zero(inner_, 3), own = sum;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto& [a, b, c] = triangles_[t];
      const Vec3d normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
      const bool in_collar = t >= patch_.triangles.size();
      if (t == patch_.triangles.size()) own = sum;
      for (const std::uint32_t p : triangles_[t]) {
        const auto row = static_cast<Eigen::Index>(p);
        if (row >= inner_) continue;
        const bool turned = in_collar && own.row(row).dot(normal) < 0;
        sum.row(row) += turned ? Vec3d(-normal) : normal;
      }
    }
    for (Eigen::Index row = 0; row < inner_; ++row) {
      const double length = sum.row(row).norm();
      if (length > 0) sum.row(row) /= length;
    }
    return sum;
  }

  // Rows of the rim and the new points, each divided by the root of its area.
  [[nodiscard]] Sparse weighted_laplacian() const {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> area(points_.size(), 0);
    for (const auto& t : triangles_) {
      const double size = triangle_area(points_[t[0]], points_[t[1]], points_[t[2]]);
      for (std::size_t k = 0; k < 3; ++k) {
        area[t[k]] += size / 3;
        add_edge(t[(k + 1) % 3], t[(k + 2) % 3], cotangent(t, k), entries);
      }
    }
    Sparse laplacian(inner_, static_cast<Eigen::Index>(points_.size()));
    for (auto& entry : entries) {
      const double scale = std::sqrt(std::max(area[static_cast<std::size_t>(entry.row())], 1e-300));
      entry = {entry.row(), entry.col(), entry.value() / scale};
    }
    laplacian.setFromTriplets(entries.begin(), entries.end());
    return laplacian;
  }

  // Of the angle at corner k, kept from what needles would make of it.
  [[nodiscard]] double cotangent(const std::array<std::uint32_t, 3>& t, std::size_t k) const {
    const Vec3d u = points_[t[(k + 1) % 3]] - points_[t[k]];
    const Vec3d v = points_[t[(k + 2) % 3]] - points_[t[k]];
    const double across = u.cross(v).norm();
    const double along = u.dot(v);
    if (!(across > 0)) return along > 0 ? 20 : 0.02;
    return std::clamp(along / across, 0.02, 20.0);
  }

  void add_edge(std::uint32_t a, std::uint32_t b, double weight,
                std::vector<Eigen::Triplet<double>>& entries) const {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      const auto row = static_cast<Eigen::Index>(from);
      if (row >= inner_) continue;
      entries.emplace_back(row, static_cast<Eigen::Index>(to), 0.5 * weight);
      entries.emplace_back(row, row, -0.5 * weight);
    }
  }

  PatchMesh& patch_;
  Eigen::Index rim_, inner_;  // the new points lie between these positions
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Vec3d> points_;
  double farthest_ = 0;
};

double mean_bend(const Rim& rim, const PatchMesh& patch) {
  return mean_bend(rim, patch.points, patch.triangles);
}

// Not where it went far away, or leaves the rim more steeply than the flat patch.
bool is_sound(const PatchMesh& bent, const PatchMesh& flat, const Rim& rim) {
  const double reach = 0.5 * extent_of(rim.points);
  for (std::size_t i = rim.size(); i < bent.points.size(); ++i) {
    if ((bent.points[i] - flat.points[i]).norm() > reach) return false;
  }
  return mean_bend(rim, bent) <= mean_bend(rim, flat);
}

bool bend_least(PatchMesh& patch, const Rim& rim, const Collar& collar,
                const std::function<void()>& poll) {
  for (int round = 0; round < kLeastRounds; ++round) {
    if (poll) poll();
    if (!Bending(patch, rim, collar).solve(Bending::Kind::least)) return false;
  }
  return true;
}

bool bend_evenly(PatchMesh& patch, const Rim& rim, const Collar& collar,
                 const std::function<void()>& poll) {
  const double settled = kSettled * extent_of(rim.points);
  Bending bending(patch, rim, collar);
  for (int round = 0; round < kEvenRounds; ++round) {
    if (poll) poll();
    if (!bending.solve(Bending::Kind::even)) return false;
    if (bending.farthest_move() <= settled) break;
  }
  return true;
}

}  // namespace

std::optional<PatchMesh> curve_patch(const Rim& rim, const LoopTriangulation& flat,
                                     const Collar& collar, bool from_cuts,
                                     const std::function<void()>& poll) {
  if (!goes_on_curved(rim, flat, from_cuts)) return std::nullopt;
  PatchMesh patch{rim.points, flat.triangles};
  refine_patch(patch, std::max(kMostPoints, 2 * rim.size()), poll);
  if (patch.points.size() == rim.size()) return std::nullopt;
  const PatchMesh before = patch;
  if (!bend_least(patch, rim, collar, poll) || !is_sound(patch, before, rim)) return std::nullopt;
  PatchMesh even = patch;
  if (!bend_evenly(even, rim, collar, poll) || !is_sound(even, before, rim)) return patch;
  return mean_bend(rim, even) <= kAsSteep * mean_bend(rim, patch) ? even : patch;
}

}  // namespace meshrepair::internal
