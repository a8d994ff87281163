// SPDX-License-Identifier: MIT
#include "triangle_hubs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <mesh/edge_table.h>

namespace meshrepair::internal {
namespace {

constexpr std::uint32_t kManyTriangles = 256;

constexpr double kDirectionMargin = 1e-12;

// Of a triangle's corners, the one with the highest count if that is high; the lowest of several.
template <class CountOf>
std::uint32_t hub_of(const IndexTriangle& corners, CountOf count_of) {
  std::uint32_t hub = kNone;
  std::uint32_t most = kManyTriangles;
  for (const std::uint32_t c : corners) {
    const std::uint32_t count = count_of(c);
    if (count < most || (count == most && hub != kNone && hub < c)) continue;
    most = count;
    hub = c;
  }
  return hub;
}

std::size_t place_of(std::uint32_t corner, const CornerTriangle& triangle) {
  return triangle.corner[0] == corner ? 0 : triangle.corner[1] == corner ? 1 : 2;
}

// The unit vector from one point to another, each component right to a few 2^-53 however large or
// small the coordinates: a difference is rounded once and scaled by a power of two. Only where it
// could overflow is it one of halves, which are exact then, or next to nothing.
Vec3d direction(const Vec3d& from, const Vec3d& to) {
  constexpr double kLarge = 0x1p1022;
  Vec3d difference;
  std::array<int, 3> halvings{};
  int largest = std::numeric_limits<int>::min();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    halvings[k] = std::max(std::abs(from[axis]), std::abs(to[axis])) >= kLarge ? 1 : 0;
    const double share = halvings[k] != 0 ? 0.5 : 1;
    difference[axis] = share * to[axis] - share * from[axis];
    if (difference[axis] == 0) continue;
    int exponent = 0;
    (void)std::frexp(difference[axis], &exponent);
    largest = std::max(largest, exponent + halvings[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    difference[axis] = std::ldexp(difference[axis], halvings[k] - largest);
  }
  return difference.normalized();
}

}  // namespace

std::vector<std::uint32_t> find_hubs(const TriangleList& triangles) {
  const SoupCorners& corners = triangles.corners();
  const auto corners_of = [&](std::uint32_t id) {
    const auto& points = corners.soup().triangles[id];
    return IndexTriangle{corners.corner(points[0]), corners.corner(points[1]),
                         corners.corner(points[2])};
  };
  std::vector<std::uint32_t> count(corners.end(), 0);
  bool any = false;
  for (const std::uint32_t id : triangles.ids()) {
    for (const std::uint32_t c : corners_of(id)) any |= ++count[c] == kManyTriangles;
  }
  if (!any) return {};
  std::vector<std::uint32_t> hubs;
  hubs.reserve(triangles.size());
  for (const std::uint32_t id : triangles.ids()) {
    hubs.push_back(hub_of(corners_of(id), [&](std::uint32_t c) { return count[c]; }));
  }
  return hubs;
}

// The directions are an arc between the unit vectors a and b. It leaves the box of its ends by its
// height over their chord at most, which is 1 - |a + b| / 2. The unit vectors are off by a few
// 2^-53, far below the margin.
Box directions_from(std::uint32_t hub, const CornerTriangle& triangle) {
  const std::size_t k = place_of(hub, triangle);
  const Vec3d a = direction(triangle.at[k], triangle.at[(k + 1) % 3]);
  const Vec3d b = direction(triangle.at[k], triangle.at[(k + 2) % 3]);
  Box box;
  box.add(a);
  box.add(b);
  box.widen(std::max(0.0, 1 - 0.5 * (a + b).norm()) + kDirectionMargin);
  return box;
}

std::vector<std::uint32_t> find_second_hubs(std::uint32_t hub,
                                            std::span<const CornerTriangle> triangles) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const CornerTriangle& t : triangles) {
    corners.insert(corners.end(), t.corner.begin(), t.corner.end());
  }
  std::sort(corners.begin(), corners.end());
  std::vector<std::uint32_t> second;
  second.reserve(triangles.size());
  for (const CornerTriangle& t : triangles) {
    second.push_back(hub_of(t.corner, [&](std::uint32_t c) {
      const auto [first, last] = std::equal_range(corners.begin(), corners.end(), c);
      return c == hub ? 0 : static_cast<std::uint32_t>(last - first);
    }));
  }
  return second;
}

// What is square to the edge is off by a few 2^-53 of what it was taken from; so where the third
// corner is nearly in line with the edge nothing is known of the direction.
Box direction_across(std::array<std::uint32_t, 2> edge, const CornerTriangle& triangle) {
  const std::size_t p = place_of(edge[0], triangle);
  const std::size_t q = place_of(edge[1], triangle);
  const Vec3d along = direction(triangle.at[p], triangle.at[q]);
  const Vec3d to_tip = direction(triangle.at[p], triangle.at[3 - p - q]);
  const Vec3d across = to_tip - to_tip.dot(along) * along;
  const double share = across.norm();
  Box box;
  if (share < 1e-12) {
    box.add(Vec3d::Zero());
    box.widen(2);
  } else {
    box.add(Vec3d(across / share));
    box.widen(kDirectionMargin + 0x1p-46 / share);
  }
  return box;
}

}  // namespace meshrepair::internal
