// SPDX-License-Identifier: MIT
#include "hull_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

using HullTriangle = std::array<std::uint32_t, 3>;

// Points are added one by one. The triangles that a point sees from outside go, and the point is
// joined with the rim that they leave. A triangle whose plane the point lies in stays. So no
// triangle without area is made: that would have the point in line with an edge of the rim, and
// then it would lie in the plane of the triangle that goes there, too.
class Hull {
 public:
  explicit Hull(std::span<const Vec3d> points) : points_(points) {}

  std::vector<HullTriangle> run() {
    if (!start()) return {};
    for (std::uint32_t p = 0; p < points_.size(); ++p) add(p);
    return std::move(triangles_);
  }

 private:
  [[nodiscard]] int side(const HullTriangle& t, std::uint32_t p) const {
    return orientation(points_[t[0]], points_[t[1]], points_[t[2]], points_[p]);
  }

  // A tetrahedron of the first points that make one.
  bool start() {
    const auto count = static_cast<std::uint32_t>(points_.size());
    const auto first_that = [&](std::uint32_t from, const auto& holds) {
      while (from < count && !holds(from)) ++from;
      return from;
    };
    const std::uint32_t b =
        first_that(1, [&](std::uint32_t p) { return points_[p] != points_[0]; });
    if (b >= count) return false;
    const std::uint32_t c = first_that(b + 1, [&](std::uint32_t p) {
      return projection_axis(points_[0], points_[b], points_[p]) >= 0;
    });
    if (c >= count) return false;
    HullTriangle base = {0, b, c};
    const std::uint32_t d = first_that(c + 1, [&](std::uint32_t p) { return side(base, p) != 0; });
    if (d >= count) return false;
    if (side(base, d) > 0) std::swap(base[1], base[2]);
    triangles_ = {base, {base[1], base[0], d}, {base[2], base[1], d}, {base[0], base[2], d}};
    return true;
  }

  void add(std::uint32_t p) {
    rim_.clear();
    const auto sees = [&](const HullTriangle& t) {
      if (side(t, p) <= 0) return false;
      for (std::size_t k = 0; k < 3; ++k) rim_.emplace_back(t[k], t[(k + 1) % 3]);
      return true;
    };
    triangles_.erase(std::remove_if(triangles_.begin(), triangles_.end(), sees), triangles_.end());
    const auto is_inner = [&](const std::pair<std::uint32_t, std::uint32_t>& edge) {
      return std::find(rim_.begin(), rim_.end(), std::pair(edge.second, edge.first)) != rim_.end();
    };
    for (const auto& edge : rim_) {
      if (!is_inner(edge)) triangles_.push_back({edge.first, edge.second, p});
    }
  }

  std::span<const Vec3d> points_;
  std::vector<HullTriangle> triangles_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rim_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Vec3d> points) {
  return Hull(points).run();
}

namespace {

// Chords of 30 degrees are nearer by 1 - cos 15 degrees, 3.5 percent.
constexpr double kLongestChord = 0.86602540378443865;

// Halves angles until chords are short. Angles are below 180 degrees.
void append_halves(const Vec3d& p, double reach, const Vec3d& from, const Vec3d& to,
                   std::vector<Vec3d>& points) {
  const double lengths = from.norm() * to.norm();
  if (from.dot(to) >= kLongestChord * lengths) return;
  const Vec3d middle = (from + to).stableNormalized() * std::sqrt(lengths);
  if (!(middle.squaredNorm() > 0)) return;
  append_halves(p, reach, from, middle, points);
  points.emplace_back(p + reach * middle);
  append_halves(p, reach, middle, to, points);
}

}  // namespace

void append_hull(const SheetMesh& mesh, std::span<const Vec3d> points,
                 std::span<const std::uint32_t> beside, SheetWalls& walls) {
  const auto base = static_cast<std::uint32_t>(walls.soup.points.size());
  const std::vector<std::array<std::uint32_t, 3>> hull = convex_hull(points);
  if (hull.empty()) return;
  walls.soup.points.insert(walls.soup.points.end(), points.begin(), points.end());
  for (const auto& [a, b, c] : hull) {
    walls.soup.triangles.push_back({base + a, base + b, base + c});
    const Vec3d normal = (points[b] - points[a]).cross(points[c] - points[a]);
    const auto along = [&](std::uint32_t t) { return std::abs(normal.dot(mesh.normal[t])); };
    const std::uint32_t nearest =
        *std::max_element(beside.begin(), beside.end(),
                          [&](std::uint32_t s, std::uint32_t t) { return along(s) < along(t); });
    walls.source.push_back(mesh.source[nearest]);
  }
}

Vec3d on_the_way(const Vec3d& from, const Vec3d& to, double reach) {
  const double length = (to - from).norm();
  return from + 0.5 * std::min(1.0, reach / length) * (to - from);
}

void append_arc(const Vec3d& p, double reach, const Vec3d& from, const Vec3d& over, const Vec3d& to,
                std::vector<Vec3d>& points) {
  if (from.dot(to) >= kLongestChord * from.norm() * to.norm()) return;
  append_halves(p, reach, from, over, points);
  points.emplace_back(p + reach * over);
  append_halves(p, reach, over, to, points);
}

}  // namespace meshrepair::internal
