// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include <base/parallel.h>
#include <check/internal/nearest_triangle.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kBoxedPerTask = 8192;
// So much larger are balls around triangles that rounding leaves nothing out of them.
constexpr double kBallMargin = 1 + 0x1p-40;

Vec3d nearest_on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return a + t * along;
}

RawVector<Box> boxes_of(std::span<const Corners> triangles) {
  RawVector<Box> boxes(triangles.size());
  parallel_tasks(boxes.size(), kBoxedPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t t = first; t < last; ++t) {
                     boxes[t] = Box();
                     for (const Vec3d& p : triangles[t]) boxes[t].add(p);
                   }
                 });
  return boxes;
}

// Above the inside of the triangle its plane is nearest, else one of its sides. The inside is told
// by the barycentric coordinates of the foot of the perpendicular, which are clamped so that a foot
// beside the triangle, by rounding, is moved onto it.
std::optional<Vec3d> foot_inside(const Vec3d& p, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3d ab = b - a, ac = c - a, ap = p - a;
  const Vec3d normal = ab.cross(ac);
  const double size = normal.squaredNorm();
  const double v = ap.cross(ac).dot(normal);
  const double w = ab.cross(ap).dot(normal);
  if (!(v >= 0 && w >= 0 && v + w <= size && size > 0)) return std::nullopt;
  const double v_share = std::min(v / size, 1.0);
  const double w_share = std::min(w / size, 1.0 - v_share);
  return a + v_share * ab + w_share * ac;
}

std::array<Vec3d, 3> nearest_on_sides(const Vec3d& p, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  return {nearest_on_segment(p, a, b), nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)};
}

}  // namespace

Vec3d nearest_point(const Vec3d& p, const Corners& triangle) {
  if (const std::optional<Vec3d> foot = foot_inside(p, triangle)) return *foot;
  const std::array<Vec3d, 3> nearest = nearest_on_sides(p, triangle);
  return *std::min_element(nearest.begin(), nearest.end(), [&](const Vec3d& q, const Vec3d& r) {
    return (q - p).squaredNorm() < (r - p).squaredNorm();
  });
}

double squared_distance(const Vec3d& p, const Corners& triangle) {
  if (const std::optional<Vec3d> foot = foot_inside(p, triangle)) return (*foot - p).squaredNorm();
  const auto& [q, r, s] = nearest_on_sides(p, triangle);
  return std::min({(q - p).squaredNorm(), (r - p).squaredNorm(), (s - p).squaredNorm()});
}

// Around the middle of the triangle's box.
NearestTriangle::Ball::Ball(const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  centre = 0.5 * a.cwiseMin(b).cwiseMin(c) + 0.5 * a.cwiseMax(b).cwiseMax(c);
  double squared = 0;
  for (const Vec3d& p : triangle) squared = std::max(squared, (p - centre).squaredNorm());
  radius = kBallMargin * std::sqrt(squared);
}

NearestTriangle::NearestTriangle(std::span<const Corners> triangles)
    : tree_(boxes_of(triangles)), triangles_(triangles.size()), balls_(triangles.size()) {
  parallel_tasks(triangles.size(), kBoxedPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t t = first; t < last; ++t) {
                     triangles_[t] = triangles[tree_.order()[t]];
                     balls_[t] = Ball(triangles_[t]);
                   }
                 });
}

Nearest NearestTriangle::find(const Vec3d& p, std::uint32_t hint) const {
  struct Candidate {
    std::uint32_t node;
    double squared_distance;
  };
  // The tree is balanced: 32 levels hold all 32-bit numbers, and each leaves one node behind.
  std::array<Candidate, 40> stack;
  std::size_t size = 0;
  Nearest best = {squared_distance(p, triangles_[hint]), hint};
  double reach = std::sqrt(best.squared_distance);
  stack[size++] = {0, 0};
  while (size > 0) {
    const Candidate candidate = stack[--size];
    if (candidate.squared_distance >= best.squared_distance) continue;
    const BoxNode& node = tree_.nodes()[candidate.node];
    if (node.is_leaf()) {
      for (std::uint32_t t = node.first; t < node.first + node.count; ++t) {
        if (balls_[t].is_beyond(p, reach)) continue;
        const double distance = squared_distance(p, triangles_[t]);
        if (distance >= best.squared_distance) continue;
        best = {distance, t};
        reach = std::sqrt(distance);
      }
      continue;
    }
    Candidate near = {candidate.node + 1, 0}, far = {node.right, 0};
    near.squared_distance = tree_.nodes()[near.node].box.squared_distance(p);
    far.squared_distance = tree_.nodes()[far.node].box.squared_distance(p);
    if (far.squared_distance < near.squared_distance) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

}  // namespace meshrepair::internal
