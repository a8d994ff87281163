#include "split_triangles.h"

#include <utility>

namespace meshrepair::internal {

std::vector<TriangleInPieces> split_triangles(const CleanSoup& soup,
                                              const std::vector<EdgeSplit>& splits) {
  std::vector<TriangleInPieces> split;
  for (std::size_t first = 0; first < splits.size();) {
    const TriangleId t(splits[first].side / 3);
    std::size_t end = first;
    while (end < splits.size() && splits[end].side / 3 == t.value) ++end;
    const auto& [a, b, c] = soup.triangles[t].corners;
    split.push_back(
        {t, first, end,
         split_triangle({a.value, b.value, c.value}, splits.data() + first, splits.data() + end)});
    first = end;
  }
  return split;
}

void put_in(CleanSoup& soup, const std::vector<TriangleInPieces>& split) {
  IdVector<TriangleId, Triangle> triangles;
  std::size_t more = 0;
  for (const TriangleInPieces& in : split) more += in.corners.size() - 1;
  triangles.reserve(soup.triangles.size() + more);
  auto next = split.begin();
  for (TriangleId t(0u); t.index() < soup.triangles.size(); ++t.value) {
    if (next == split.end() || next->triangle != t) {
      triangles.push_back(soup.triangles[t]);
      continue;
    }
    Triangle piece = soup.triangles[t];
    for (const auto& [a, b, c] : next->corners) {
      piece.corners = {PointId(a), PointId(b), PointId(c)};
      triangles.push_back(piece);
    }
    ++next;
  }
  soup.triangles = std::move(triangles);
}

}  // namespace meshrepair::internal
