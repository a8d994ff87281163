#include "curve_patch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/SparseCholesky>

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

bool is_planar(const Rim& rim) {
  Vec3d normal = Vec3d::Zero(), middle = Vec3d::Zero();
  for (std::size_t i = 0; i < rim.size(); ++i) {
    normal +=
        (rim.points[i] - rim.points[0]).cross(rim.points[(i + 1) % rim.size()] - rim.points[0]);
    middle += rim.points[i];
  }
  middle /= static_cast<double>(rim.size());
  normal.normalize();
  const double allowed = kPlanar * extent_of(rim.points);
  return std::all_of(rim.points.begin(), rim.points.end(),
                     [&](const Vec3d& p) { return std::abs(normal.dot(p - middle)) <= allowed; });
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
      sum += weight * std::acos(std::clamp(-cosine, -1.0, 1.0));
      length += weight;
    }
  }
  return length > 0 ? sum / length : 0;
}

bool goes_on_curved(const Rim& rim, const LoopTriangulation& flat) {
  if (rim.size() < kShortestRim) return false;
  const double bend = mean_bend(rim, rim.points, flat.triangles);
  if (bend < kStraight || bend > kSteep) return false;
  return bend <= kSteepAtPlane || !is_planar(rim);
}

// Solves for the new points: they minimise the sum over all points of the rim and the patch of
// |L x|^2 / area, L the cotangent Laplacian of the patch and the collar.
class Bending {
 public:
  Bending(PatchMesh& patch, const Rim& rim, const Collar& collar)
      : patch_(patch),
        rim_(static_cast<Eigen::Index>(rim.size())),
        inner_(static_cast<Eigen::Index>(patch.points.size())),
        triangles_(patch.triangles),
        points_(patch.points) {
    points_.insert(points_.end(), collar.points.begin(), collar.points.end());
    const auto shift = static_cast<std::uint32_t>(inner_ - rim_);
    for (auto t : collar.triangles) {
      for (std::uint32_t& p : t) p += p < rim_ ? 0 : shift;
      triangles_.push_back(t);
    }
  }

  // With weights of the shape at hand; false where that gives no numbers.
  bool solve() {
    const Sparse laplacian = weighted_laplacian();
    const Sparse moving = laplacian.middleCols(rim_, inner_ - rim_);
    Positions fixed(laplacian.cols(), 3);
    for (Eigen::Index i = 0; i < fixed.rows(); ++i) {
      const bool is_moving = i >= rim_ && i < inner_;
      fixed.row(i) = is_moving ? Vec3d::Zero() : points_[static_cast<std::size_t>(i)];
    }
    const Sparse system = moving.transpose() * moving;
    const Positions right = -(moving.transpose() * (laplacian * fixed));
    Eigen::SimplicialLDLT<Sparse> solver(system);
    if (solver.info() != Eigen::Success) return false;
    const Positions solution = solver.solve(right);
    if (solver.info() != Eigen::Success || !solution.allFinite()) return false;
    for (Eigen::Index i = rim_; i < inner_; ++i) {
      const Vec3d at = solution.row(i - rim_);
      points_[static_cast<std::size_t>(i)] = at;
      patch_.points[static_cast<std::size_t>(i)] = at;
    }
    return true;
  }

 private:
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
};

// Not where it went far away, or leaves the rim more steeply than the flat patch.
bool is_sound(const PatchMesh& bent, const PatchMesh& flat, const Rim& rim) {
  const double reach = 0.5 * extent_of(rim.points);
  for (std::size_t i = rim.size(); i < bent.points.size(); ++i) {
    if ((bent.points[i] - flat.points[i]).norm() > reach) return false;
  }
  return mean_bend(rim, bent.points, bent.triangles) <= mean_bend(rim, flat.points, flat.triangles);
}

}  // namespace

std::optional<PatchMesh> curve_patch(const Rim& rim, const LoopTriangulation& flat,
                                     const Collar& collar, const std::function<void()>& poll) {
  if (!goes_on_curved(rim, flat)) return std::nullopt;
  PatchMesh patch{rim.points, flat.triangles};
  refine_patch(patch, std::max(kMostPoints, 2 * rim.size()), poll);
  if (patch.points.size() == rim.size()) return std::nullopt;
  const PatchMesh before = patch;
  // The second time with the weights of the bent shape.
  for (int round = 0; round < 2; ++round) {
    if (poll) poll();
    if (!Bending(patch, rim, collar).solve()) return std::nullopt;
  }
  if (!is_sound(patch, before, rim)) return std::nullopt;
  return patch;
}

}  // namespace meshrepair::internal
