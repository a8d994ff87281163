// SPDX-License-Identifier: MIT
#include "common/wall_judge.h"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include <base/parallel.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kPlacesPerTask = 256;
// Pieces of a tetrahedron: with fewer, large ones over several triangles of a flat face are
// refused, and more triangles are left, which takes as long.
constexpr std::size_t kMostSwept = 256;
constexpr double kLong = 0.25;  // of the depth: sides that are looked at in three points
// Of the error, at the points that are looked at: between them it may be less deep.
constexpr double kSeen = 0.65;

}  // namespace

WallJudge::WallJudge(const Depth& depth, const std::vector<Vec3d>& points, double thickness,
                     double error)
    : depth_(depth),
      least_(thickness - kSeen * error),
      most_(thickness + error),
      places_(points.size()) {
  parallel_tasks(points.size(), kPlacesPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   std::uint32_t near = 0;
                   for (std::size_t i = first; i < last; ++i) {
                     places_[i] = depth.place(points[i], near);
                     near = places_[i].nearest;
                   }
                 });
}

// What takes longest is last.
bool WallJudge::allows(const Question& question) {
  place_ = depth_.place(question.place, places_[question.point].nearest);
  if (place_.distance < least_ || place_.distance > most_) return false;
  const auto now = [&](const std::array<std::uint32_t, 3>& triangle) {
    const auto at = [&](std::uint32_t p) { return p == question.point ? place_ : places_[p]; };
    const auto& [a, b, c] = triangle;
    return Piece{at(a), at(b), at(c), at(c)};
  };
  double turned = 0;
  for (const auto& triangle : question.after) {
    const Piece piece = now(triangle);
    if (!is_deep(piece)) return false;
    turned += turned_area(piece);
  }
  if (turned > 0) {
    for (const auto& [a, b, c] : question.before) {
      turned -= turned_area({places_[a], places_[b], places_[c], places_[c]});
    }
    if (turned > 0) return false;
  }
  return std::all_of(question.before.begin(), question.before.end(), [&](const auto& triangle) {
    const auto& [a, b, c] = triangle;
    DepthProver prover(depth_, kMostSwept);
    return prover.is_within({place_, places_[a], places_[b], places_[c]}, most_) == Proof::holds;
  });
}

// Twice the area of a triangle that is seen from the cavity, as its middle tells; else nothing.
double WallJudge::turned_area(const Piece& triangle) const {
  const auto& [a, b, c, d] = triangle;
  const Vec3d normal = (b.at - a.at).cross(c.at - a.at);
  const bool is_clear = std::none_of(triangle.begin(), triangle.end(), [&](const Place& corner) {
    return normal.dot(depth_.inward(corner)) > 0;
  });
  if (is_clear) return 0;
  const Place middle = depth_.place((a.at + b.at + c.at) / 3, a.nearest);
  return normal.dot(depth_.inward(middle)) > 0 ? normal.norm() : 0;
}

// The first side is new for each triangle of a fan; the second one was there before.
bool WallJudge::is_deep(const Piece& triangle) const {
  DepthProver prover(depth_, 1);
  const Proof proof = prover.is_beyond(triangle, least_);
  if (proof != Proof::open) return proof == Proof::holds;
  const Vec3d &a = triangle[0].at, &b = triangle[1].at, &c = triangle[2].at;
  const auto is_deep_at = [&](const Vec3d& at) {
    return depth_.place(at, triangle[1].nearest).distance >= least_;
  };
  if (!is_deep_at(0.5 * a + 0.5 * b) || !is_deep_at((a + b + c) / 3)) return false;
  const double room = kLong * least_;
  return (a - b).squaredNorm() < room * room ||
         (is_deep_at(0.25 * a + 0.75 * b) && is_deep_at(0.75 * a + 0.25 * b));
}

}  // namespace meshrepair::internal
