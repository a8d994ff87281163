// SPDX-License-Identifier: MIT
// From the middle of a large triangle inward: half as far each time, until nothing lies between
// that place and one right behind the triangle.
#include "point_inside.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <check/soup_rays.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kMostTriangles = 64;
constexpr int kMostHalvings = 24;

// Of the size of a triangle: how far behind it a place is that still counts as right behind it.
constexpr double kRightBehind = 0x1p-20;

}  // namespace

std::optional<Vec3d> point_inside(const TriangleSoup& boundary) {
  std::vector<std::pair<double, std::uint32_t>> by_area;
  for (std::uint32_t t = 0; t < boundary.triangles.size(); ++t) {
    const auto& [a, b, c] = boundary.triangles[t];
    const std::vector<Vec3d>& at = boundary.points;
    by_area.emplace_back(-(at[b] - at[a]).cross(at[c] - at[a]).norm(), t);
  }
  const std::size_t tried = std::min(kMostTriangles, by_area.size());
  std::partial_sort(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(tried),
                    by_area.end());
  const std::vector<std::int32_t> once(boundary.triangles.size(), 1);
  const SoupRays rays(boundary, once);
  for (std::size_t i = 0; i < tried; ++i) {
    const auto& [a, b, c] = boundary.triangles[by_area[i].second];
    const std::vector<Vec3d>& at = boundary.points;
    const Vec3d middle = (at[a] + at[b] + at[c]) / 3;
    const Vec3d normal = (at[b] - at[a]).cross(at[c] - at[a]);
    const double size = normal.norm();
    if (!(size > 0)) continue;
    const Vec3d inward = normal / -size * std::sqrt(size);  // as long as the triangle is wide
    const Vec3d behind = middle + kRightBehind * inward;
    if (rays.winding_at(behind) != 1) continue;
    double far = 1;
    for (int k = 0; k < kMostHalvings; ++k, far /= 2) {
      const Vec3d place = middle + far * inward;
      if (rays.sees(behind, place) && rays.winding_at(place) == 1) return place;
    }
  }
  return std::nullopt;
}

}  // namespace meshrepair::internal
