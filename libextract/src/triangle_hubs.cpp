#include "triangle_hubs.h"

#include <algorithm>
#include <cmath>

namespace meshrepair::internal {
namespace {

constexpr std::uint32_t kManyTriangles = 256;

constexpr double kMargin = 1e-12;

// Of a triangle's corners, the one with the highest count if that is high; the lowest of several.
template <class CountOf>
std::uint32_t hub_of(const CornerTriangle& triangle, CountOf count_of) {
  std::uint32_t hub = kNoHub;
  std::uint32_t most = kManyTriangles;
  for (const std::uint32_t c : triangle.corner) {
    const std::uint32_t count = count_of(c);
    if (count < most || (count == most && hub != kNoHub && hub < c)) continue;
    most = count;
    hub = c;
  }
  return hub;
}

std::size_t place_of(std::uint32_t corner, const CornerTriangle& triangle) {
  return triangle.corner[0] == corner ? 0 : triangle.corner[1] == corner ? 1 : 2;
}

// The unit vectors to the other two corners.
std::array<Vec3d, 2> ends_from(std::uint32_t hub, const CornerTriangle& triangle) {
  const std::size_t k = place_of(hub, triangle);
  // Halved, so that no difference overflows.
  const Vec3d from = 0.5 * triangle.at[k];
  return {(0.5 * triangle.at[(k + 1) % 3] - from).stableNormalized(),
          (0.5 * triangle.at[(k + 2) % 3] - from).stableNormalized()};
}

void widen(Box& box, double margin) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] -= margin;
    box.high[axis] += margin;
  }
}

}  // namespace

std::vector<std::uint32_t> find_hubs(std::span<const CornerTriangle> triangles) {
  std::uint32_t corners = 0;
  for (const CornerTriangle& t : triangles) {
    corners = std::max(corners, *std::max_element(t.corner.begin(), t.corner.end()) + 1);
  }
  std::vector<std::uint32_t> count(corners, 0);
  for (const CornerTriangle& t : triangles) {
    for (const std::uint32_t c : t.corner) ++count[c];
  }
  std::vector<std::uint32_t> hubs;
  hubs.reserve(triangles.size());
  for (const CornerTriangle& t : triangles) {
    hubs.push_back(hub_of(t, [&](std::uint32_t c) { return count[c]; }));
  }
  return hubs;
}

// The directions are an arc between the unit vectors a and b. It leaves the box of its ends by its
// height over their chord c at most, 1 - sqrt(1 - c^2 / 4). A difference of two coordinates is
// rounded once, so the unit vectors are off by a few 2^-53, far below the margin.
Box directions_from(std::uint32_t hub, const CornerTriangle& triangle) {
  const auto [a, b] = ends_from(hub, triangle);
  const double chord = std::min((a - b).norm(), 2.0);
  const double margin = 1 - std::sqrt(std::max(0.0, 1 - 0.25 * chord * chord)) + kMargin;
  Box box;
  box.add(a);
  box.add(b);
  widen(box, margin);
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
    second.push_back(hub_of(t, [&](std::uint32_t c) {
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
  // Halved, so that no difference overflows.
  const Vec3d from = 0.5 * triangle.at[p];
  const Vec3d along = (0.5 * triangle.at[q] - from).stableNormalized();
  const Vec3d to_tip = (0.5 * triangle.at[3 - p - q] - from).stableNormalized();
  const Vec3d across = to_tip - to_tip.dot(along) * along;
  const double share = across.norm();
  Box box;
  if (share < 1e-12) {
    box.add(Vec3d::Zero());
    widen(box, 2);
  } else {
    box.add(Vec3d(across / share));
    widen(box, kMargin + 0x1p-46 / share);
  }
  return box;
}

}  // namespace meshrepair::internal
