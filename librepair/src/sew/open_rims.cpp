// SPDX-License-Identifier: MIT
#include "open_rims.h"

#include <algorithm>
#include <limits>

#include <base/ids.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

bool is_sound(const TriangleSoup& soup, const IndexTriangle& t) {
  return t[0] != t[1] && t[1] != t[2] && t[2] != t[0] && soup.points[t[0]].allFinite() &&
         soup.points[t[1]].allFinite() && soup.points[t[2]].allFinite();
}

void note_sizes(const TriangleSoup& soup, OpenRims& rims) {
  rims.size.assign(soup.points.size(), std::numeric_limits<double>::infinity());
  for (const std::uint32_t side : rims.sides) {
    const IndexTriangle& t = rims.triangles[side / 3];
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      shortest = std::min(shortest, (soup.points[t[(k + 1) % 3]] - soup.points[t[k]]).norm());
    }
    for (const std::uint32_t end : ends_of(rims, side)) {
      rims.size[end] = std::min(rims.size[end], shortest);
    }
  }
}

}  // namespace

OpenRims find_open_rims(const TriangleSoup& soup) {
  OpenRims rims;
  rims.place = first_in_place(soup.points);
  const std::vector<std::uint32_t>& place = rims.place;
  rims.triangles.reserve(soup.triangles.size());
  std::vector<std::uint32_t> across(3 * soup.triangles.size(), kNone);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& c = soup.triangles[t];
    rims.triangles.push_back({place[c[0]], place[c[1]], place[c[2]]});
    if (is_sound(soup, rims.triangles.back())) continue;
    for (std::size_t k = 0; k < 3; ++k) across[3 * t + k] = 0;
  }
  rims.open_at.assign(soup.points.size(), 0);
  rims.is_crowded.assign(soup.points.size(), 0);
  const EdgeTable edges(rims.triangles, across);
  edges.for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() == 1) rims.sides.push_back(sides[0]);
    if (sides.size() <= 2) return;
    for (const std::uint32_t end : ends_of(rims, sides[0])) rims.is_crowded[end] = 1;
  });
  for (const std::uint32_t side : rims.sides) {
    for (const std::uint32_t end : ends_of(rims, side)) {
      rims.corners.push_back(end);
      ++rims.open_at[end];
    }
  }
  std::sort(rims.corners.begin(), rims.corners.end());
  rims.corners.erase(std::unique(rims.corners.begin(), rims.corners.end()), rims.corners.end());
  note_sizes(soup, rims);
  return rims;
}

}  // namespace meshrepair::internal
