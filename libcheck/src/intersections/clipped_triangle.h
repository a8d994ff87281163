// SPDX-License-Identifier: MIT
// The part of a triangle in a box and beyond walls, rounded.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Coordinates are at most 1. A point that two triangles have in common is in one of the two halves
// of each place that is halved, and this far at least from its walls, but for rounding. What
// rounding in clip() can lose of a triangle lies within a few 2^-53 of a wall, so that the point is
// kept in both triangles' parts.
inline constexpr double kClipMargin = 0x1p-42;

// A plane by its unit normal; heights are rounded.
struct Wall {
  Vec3d normal;
  double offset = 0;

  [[nodiscard]] double height(const Vec3d& point) const { return normal.dot(point) - offset; }
};

// A convex polygon of at most nine corners, ten beyond a wall.
class ClippedTriangle {
 public:
  ClippedTriangle(const std::array<Vec3d, 3>& corners, const Box& box);

  // Keeps what is at most kClipMargin below the wall.
  void clip(const Wall& wall);

  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::span<const Vec3d> corners() const { return {corners_.data(), count_}; }
  // With a margin.
  [[nodiscard]] Box box() const;

 private:
  template <class Height>
  void keep_above(Height height, int axis, double limit);

  // Each plane adds one at most; the rest is room for what rounding could do.
  static constexpr std::size_t kMostCorners = 16;
  std::array<Vec3d, kMostCorners> corners_;
  std::size_t count_ = 3;
};

}  // namespace meshrepair::internal
