#include "nearby_part.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <base/ids.h>
#include <base/parallel.h>
#include <check/triangle_list.h>

namespace meshrepair::internal {
namespace {

// Enough that looking up takes longer than handing out the task.
constexpr std::size_t kBoxesPerTask = 16384;

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

std::vector<std::uint32_t> triangles_near(const TriangleSoup& soup, std::span<const Box> boxes,
                                          double reach) {
  const BoxTree tree(boxes);
  const auto find = [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> near;
    for (std::size_t t = first; t < last; ++t) {
      const auto id = static_cast<std::uint32_t>(t);
      Box box = box_of(soup, id);
      box.widen(reach);
      if (meets_any(tree, boxes, box)) near.push_back(id);
    }
    return near;
  };
  return parallel_reduce(soup.triangles.size(), kBoxesPerTask, find,
                         [](std::vector<std::uint32_t>& all, std::vector<std::uint32_t> part) {
                           all.insert(all.end(), part.begin(), part.end());
                         });
}

NearbyPart nearby_part(const TriangleSoup& soup, std::span<const std::uint32_t> among,
                       double reach) {
  const SoupCorners corners(soup, false);
  const TriangleList list(corners, among);
  // Those that were left out have nothing near them, but are to be counted.
  NearbyPart part;
  part.triangles = triangles_near(soup, list.boxes(), reach);
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
