// SPDX-License-Identifier: MIT
// Winding numbers at single places, where no cells tell them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair {

class SoupRays {
 public:
  // `winding` says for each triangle how often it counts, turned as its corners are; at every edge
  // what is turned the one way balances what is turned the other way. Both must outlive the object.
  // n log n; a ray costs about the square root of n.
  SoupRays(const TriangleSoup& soup, std::span<const std::int32_t> winding);

  // At a point that lies on no triangle, exactly.
  [[nodiscard]] std::int32_t winding_at(const Vec3d& point) const;

  // Whether certainly nothing lies between the two points.
  [[nodiscard]] bool sees(const Vec3d& from, const Vec3d& to) const;

 private:
  const TriangleSoup& soup_;
  std::span<const std::int32_t> winding_;
  BoxTree tree_;
};

// A ray up the z axis from right beside a corner of a triangle, inside of it.
struct CornerRay {
  std::uint32_t triangle = 0, corner = 0;
};

// The triangles that each ray passes, ascending, but for its own, exactly. None of their own is
// parallel to z. Each of the n triangles is looked at once, against a tree of the r rays: n log r,
// and memory for the rays and the result alone.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> triangles_above(
    const TriangleSoup& soup, std::span<const CornerRay> rays);

}  // namespace meshrepair
