// SPDX-License-Identifier: MIT
#include "nearby_part.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <base/ids.h>
#include <check/internal/nearby_intersections.h>
#include <check/internal/triangle_list.h>

namespace meshrepair::internal {
namespace {

TriangleSoup part_of(const TriangleSoup& soup, std::span<const std::uint32_t> triangles) {
  TriangleSoup part;
  std::vector<std::uint32_t> index(soup.points.size(), kNone);
  part.triangles.reserve(triangles.size());
  for (const std::uint32_t t : triangles) {
    std::array<std::uint32_t, 3> corners = soup.triangles[t];
    for (std::uint32_t& p : corners) {
      if (index[p] == kNone) {
        index[p] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(soup.points[p]);
      }
      p = index[p];
    }
    part.triangles.push_back(corners);
  }
  return part;
}

}  // namespace

NearbyPart nearby_part(const TriangleSoup& soup, std::span<const std::uint32_t> among,
                       double margin) {
  const SoupCorners corners(soup, false);
  const TriangleList list(corners, among);
  // Those that were left out have nothing near them, but are to be counted.
  NearbyPart part;
  part.triangles = triangles_near(soup, list.boxes(), margin);
  part.triangles.insert(part.triangles.end(), among.begin(), among.end());
  std::sort(part.triangles.begin(), part.triangles.end());
  part.triangles.erase(std::unique(part.triangles.begin(), part.triangles.end()),
                       part.triangles.end());
  part.soup = part_of(soup, part.triangles);
  part.among.reserve(among.size());
  for (const std::uint32_t t : among) {
    part.among.push_back(static_cast<std::uint32_t>(
        std::lower_bound(part.triangles.begin(), part.triangles.end(), t) -
        part.triangles.begin()));
  }
  return part;
}

}  // namespace meshrepair::internal
