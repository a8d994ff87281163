// SPDX-License-Identifier: MIT
// The parts of a closed mesh, and how large each is.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

// Connected through points, numbered from 0 by their first triangles.
struct MeshParts {
  std::vector<std::uint32_t> of_triangle;
  std::uint32_t count = 0;
};

[[nodiscard]] MeshParts find_parts(const TriangleSoup& mesh);

// Brings all coordinates to at most 1, by a power of two, so that no volume overflows, and none of
// a part that the working grid can hold is lost below the smallest number.
class UnitScale {
 public:
  explicit UnitScale(std::span<const Vec3d> points);

  [[nodiscard]] double operator()(double length) const { return length * first_ * second_; }
  [[nodiscard]] Vec3d operator()(const Vec3d& point) const { return point * first_ * second_; }
  // The inverse.
  [[nodiscard]] double back(double length) const { return length / first_ / second_; }
  [[nodiscard]] Vec3d back(const Vec3d& point) const { return point / first_ / second_; }

 private:
  double first_ = 1, second_ = 1;  // powers of two
};

// Scaled. A slab that is thin beside its extent is 2 volume / area thick.
struct PartSize {
  double volume = 0;  // signed: above 0 if the part faces outward
  double area = 0;
};

// Of each of the parts 0 to parts - 1, seen from one of its own points: rounding would leave
// nothing of small ones far from the origin. `part_of` has one entry for each triangle.
[[nodiscard]] std::vector<PartSize> part_sizes(
    std::span<const Vec3d> points, std::span<const std::array<std::uint32_t, 3>> triangles,
    std::span<const std::uint32_t> part_of, std::uint32_t parts, const UnitScale& scale);

}  // namespace meshrepair
