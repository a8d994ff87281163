// SPDX-License-Identifier: MIT
#include "triangle_rays.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include <check/internal/triangle_list.h>

namespace meshrepair::internal {
namespace {

RawVector<Box> boxes_of(const TriangleSoup& mesh) {
  RawVector<Box> boxes(mesh.triangles.size());
  for (std::uint32_t t = 0; t < boxes.size(); ++t) boxes[t] = box_of(mesh, t);
  return boxes;
}

struct Ray {
  Vec3d from, direction, inverse;

  Ray(const TriangleSoup& mesh, std::uint32_t triangle, const Vec3d& along)
      : direction(along), inverse(along.cwiseInverse()) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    from = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
  }

  // Whether a box lies on it, no farther than `reach`. Where the ray runs along a face of the box
  // the product is no number, and the comparisons let it pass.
  [[nodiscard]] bool meets(const Box& box, double reach) const {
    double enter = 0, leave = reach;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      double near = (box.low[k] - from[axis]) * inverse[axis];
      double far = (box.high[k] - from[axis]) * inverse[axis];
      if (near > far) std::swap(near, far);
      if (near > enter) enter = near;
      if (far < leave) leave = far;
    }
    return enter <= leave;
  }

  // The distance to a triangle; infinite if it is not met.
  [[nodiscard]] double to(const TriangleSoup& mesh, std::uint32_t triangle) const {
    const auto& corners = mesh.triangles[triangle];
    const Vec3d& a = mesh.points[corners[0]];
    const Vec3d ab = mesh.points[corners[1]] - a, ac = mesh.points[corners[2]] - a;
    const Vec3d start = from - a;
    const Vec3d across = direction.cross(ac);
    const double determinant = ab.dot(across);
    const double u = start.dot(across) / determinant;
    const Vec3d other = start.cross(ab);
    const double v = direction.dot(other) / determinant;
    const double distance = ac.dot(other) / determinant;
    const bool is_met = u >= 0 && v >= 0 && u + v <= 1 && distance > 0;
    return is_met ? distance : std::numeric_limits<double>::infinity();
  }
};

}  // namespace

TriangleRays::TriangleRays(const TriangleSoup& mesh) : mesh_(mesh), tree_(boxes_of(mesh)) {}

RayHit TriangleRays::first_hit(std::uint32_t triangle, const Vec3d& direction, double reach) const {
  const Ray ray(mesh_, triangle, direction);
  RayHit hit;
  tree_.visit([&](const Box& box) { return ray.meets(box, std::min(reach, hit.distance)); },
              [&](std::uint32_t t) {
                if (t == triangle) return;
                const double distance = ray.to(mesh_, t);
                if (distance < hit.distance && distance <= reach) hit = {distance, t};
              });
  return hit;
}

bool TriangleRays::escapes(std::uint32_t triangle, const Vec3d& direction) const {
  const Ray ray(mesh_, triangle, direction);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  bool is_met = false;
  tree_.visit(
      [&](const Box& box) { return !is_met && ray.meets(box, kFar); },
      [&](std::uint32_t t) { is_met = is_met || (t != triangle && ray.to(mesh_, t) < kFar); });
  return !is_met;
}

}  // namespace meshrepair::internal
