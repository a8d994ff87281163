#include "triangle_hubs.h"

#include <algorithm>
#include <cmath>

namespace meshrepair::internal {
namespace {

constexpr std::uint32_t kManyTriangles = 256;

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
  std::vector<std::uint32_t> hubs(triangles.size(), kNoHub);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::uint32_t most = kManyTriangles;
    for (const std::uint32_t c : triangles[t].corner) {
      if (count[c] < most || (count[c] == most && hubs[t] != kNoHub && hubs[t] < c)) continue;
      most = count[c];
      hubs[t] = c;
    }
  }
  return hubs;
}

// The directions are an arc between the unit vectors a and b. It leaves the box of its ends by its
// height over their chord c at most, 1 - sqrt(1 - c^2 / 4). A difference of two coordinates is
// rounded once, so the unit vectors are off by a few 2^-53, far below the margin.
Box directions_from(std::uint32_t hub, const CornerTriangle& triangle) {
  constexpr double kMargin = 1e-12;
  const std::size_t k = triangle.corner[0] == hub ? 0 : triangle.corner[1] == hub ? 1 : 2;
  // Halved, so that no difference overflows.
  const Vec3d from = 0.5 * triangle.at[k];
  const Vec3d a = (0.5 * triangle.at[(k + 1) % 3] - from).stableNormalized();
  const Vec3d b = (0.5 * triangle.at[(k + 2) % 3] - from).stableNormalized();
  const double chord = std::min((a - b).norm(), 2.0);
  const double margin = 1 - std::sqrt(std::max(0.0, 1 - 0.25 * chord * chord)) + kMargin;
  Box box;
  box.add(a);
  box.add(b);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] -= margin;
    box.high[axis] += margin;
  }
  return box;
}

}  // namespace meshrepair::internal
