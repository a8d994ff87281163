// Winding numbers at single places, where no cells tell them.
#pragma once

#include <cstdint>
#include <optional>
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

  // Right above the triangle, on the side of it to which z grows, at a place inside it near its
  // first corner, exactly. Nothing if it is parallel to z. No other triangle passes through it.
  [[nodiscard]] std::optional<std::int32_t> winding_above(std::uint32_t triangle) const;

  // 1 where the triangle, turned as its corners are, faces up, to where z grows, -1 where it faces
  // down, 0 where it is parallel to z.
  [[nodiscard]] int facing(std::uint32_t triangle) const;

  static constexpr std::uint32_t kNoTriangle = ~std::uint32_t{0};
  // Whether certainly nothing lies between the two points, or nothing but that triangle.
  [[nodiscard]] bool sees(const Vec3d& from, const Vec3d& to,
                          std::uint32_t but = kNoTriangle) const;

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
