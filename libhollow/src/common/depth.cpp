// SPDX-License-Identifier: MIT
#include "common/depth.h"

#include <cmath>

namespace meshrepair::internal {
namespace {

std::vector<Corners> corners_of(const TriangleSoup& soup) {
  std::vector<Corners> corners;
  corners.reserve(soup.triangles.size());
  for (const auto& [a, b, c] : soup.triangles) {
    corners.push_back({soup.points[a], soup.points[b], soup.points[c]});
  }
  return corners;
}

}  // namespace

Depth::Depth(const TriangleSoup& solid)
    : winding_(solid.triangles.size(), 1),
      rays_(solid, winding_),
      corners_(corners_of(solid)),
      nearest_(corners_) {}

Place Depth::place(const Vec3d& at, std::uint32_t hint) const {
  const Nearest found = nearest_.find(at, hint);
  return {at, std::sqrt(found.squared_distance), found.triangle};
}

}  // namespace meshrepair::internal
