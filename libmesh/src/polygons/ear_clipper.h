// SPDX-License-Identifier: MIT
// Cuts a polygon in the plane into triangles, ear by ear.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace meshrepair::internal {

using Flat = Eigen::Vector2d;

// Positive when a, b, c turn to the left. Rounded: a wrong sign costs a sliver, not validity.
inline double left_turn(const Flat& a, const Flat& b, const Flat& c) {
  const Flat ab = b - a;
  const Flat ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

// Which ear is cut off next, and what keeps a corner from being one.
enum class EarOrder {
  // The next ear after the last one. A convex polygon becomes a fan. left_turn() takes some points
  // for points of a sliver that lie far off in its line; they block it. For small polygons.
  around,
  // The next but one, so that a line crosses few triangles: in a convex polygon of n corners about
  // 2 log n, where a fan may have all of its n crossed. What lies beside a triangle's bounding box
  // does not block it, which is much faster where slivers are long.
  in_rounds,
};

struct EarClipping {
  // What has no ear, as positions in the polygon, ascending; empty when the triangles are all of
  // it. The triangles and this rest add up to the polygon.
  std::vector<std::uint32_t> rest;
  // Corners that were tried, and boxes and corners that were compared with one of them.
  std::size_t looked_at = 0;
};

// Appends the triangles of a polygon that turns to the left, as positions in `polygon`: goes around
// it from the first corner and cuts off ears. At least 3 corners, fewer than 2^31. In rounds near
// n log n for polygons as they occur, around near n^1.5; nothing better than n^2 is guaranteed.
EarClipping clip_ears(std::span<const Flat> polygon, EarOrder order,
                      std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace meshrepair::internal
