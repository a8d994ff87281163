// SPDX-License-Identifier: MIT
// What a ray from a triangle meets first. In doubles: to judge what a surface looks like, not to
// decide what is inside of it.
#pragma once

#include <cstdint>
#include <limits>

#include <base/raw_vector.h>
#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

struct RayHit {
  double distance = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = 0;
};

class TriangleRays {
 public:
  // Finite triangles; `mesh` outlives the object. n log n.
  explicit TriangleRays(const TriangleSoup& mesh);

  // From the centroid of a triangle along the unit vector `direction`, to no farther than `reach`.
  // The triangle itself is not met.
  [[nodiscard]] RayHit first_hit(std::uint32_t triangle, const Vec3d& direction,
                                 double reach) const;
  [[nodiscard]] bool escapes(std::uint32_t triangle, const Vec3d& direction) const;

 private:
  const TriangleSoup& mesh_;
  BoxTree tree_;
};

}  // namespace meshrepair::internal
