#include "hull_walls.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "convex_hull.h"

namespace meshrepair::internal {
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
