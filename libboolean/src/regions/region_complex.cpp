// SPDX-License-Identifier: MIT
#include "region_complex.h"

#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <mesh/edge_table.h>
#include <mesh/internal/editable_mesh.h>

namespace meshrepair::internal {

void turn_outside_to_front(RegionComplex& complex) {
  for (std::size_t t = 0; t < complex.parts_of.size(); ++t) {
    auto& [front, behind] = complex.parts_of[t];
    if (complex.region_of_part[behind] != kOutside) continue;
    std::swap(front, behind);
    std::swap(complex.mesh.triangles[t][1], complex.mesh.triangles[t][2]);
  }
}

RegionComplex compacted(const RegionComplex& complex, const std::vector<std::uint32_t>& becomes) {
  const auto region = [&](std::uint32_t part) { return complex.region_of_part[part]; };
  DisjointSets one(becomes.size());
  const auto& triangles = complex.mesh.triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t front = becomes[complex.parts_of[t][0]];
    const std::uint32_t behind = becomes[complex.parts_of[t][1]];
    if (triangles[t] != kGone && region(front) == region(behind)) one.join(front, behind);
  }
  RegionComplex result;
  std::vector<std::uint32_t> number(becomes.size(), kNone);
  for (std::uint32_t part = 0; part < becomes.size(); ++part) {
    if (becomes[part] != part || one.root(part) != part) continue;
    number[part] = static_cast<std::uint32_t>(result.region_of_part.size());
    result.region_of_part.push_back(region(part));
  }
  const auto now = [&](std::uint32_t part) { return number[one.root(becomes[part])]; };
  std::vector<std::uint32_t> place(complex.mesh.points.size(), kNone);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (triangles[t] == kGone) continue;
    const std::array sides = {now(complex.parts_of[t][0]), now(complex.parts_of[t][1])};
    if (sides[0] == sides[1]) continue;
    IndexTriangle corners = triangles[t];
    for (std::uint32_t& p : corners) {
      if (place[p] == kNone) {
        place[p] = static_cast<std::uint32_t>(result.mesh.points.size());
        result.mesh.points.push_back(complex.mesh.points[p]);
      }
      p = place[p];
    }
    result.mesh.triangles.push_back(corners);
    result.parts_of.push_back(sides);
    result.source.push_back(complex.source[t]);
  }
  turn_outside_to_front(result);
  return result;
}

std::vector<PartSize> sizes_of_parts(const RegionComplex& complex) {
  const std::vector<Vec3d>& points = complex.mesh.points;
  std::vector<PartSize> sizes(complex.region_of_part.size());
  for (std::uint32_t t = 0; t < complex.mesh.triangles.size(); ++t) {
    const auto& [p, q, r] = complex.mesh.triangles[t];
    for (const double sign : {-1.0, 1.0}) {
      PartSize& size = sizes[complex.parts_of[t][sign < 0 ? 0 : 1]];
      if (size.triangle == kNone) size.triangle = t;
      const Vec3d base = points[complex.mesh.triangles[size.triangle][0]];
      size.volume += sign * (points[p] - base).dot((points[q] - base).cross(points[r] - base)) / 6;
      size.area += 0.5 * (points[q] - points[p]).cross(points[r] - points[p]).norm();
    }
  }
  return sizes;
}

}  // namespace meshrepair::internal
