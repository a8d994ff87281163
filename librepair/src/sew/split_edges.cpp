// SPDX-License-Identifier: MIT
#include "split_edges.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace meshrepair::internal {
namespace {

struct Piece {
  IndexTriangle corners;
  std::array<std::vector<std::uint32_t>, 3> on_side;  // new corners in their order
};

}  // namespace

std::vector<EdgeSplit> find_splits(const OpenRims& rims, const Strangers& strangers,
                                   const CornerClusters& clusters, double distance, double share) {
  std::vector<EdgeSplit> splits;
  for (const std::uint32_t corner : rims.corners) {
    const double reach = std::min(distance, share * rims.size[corner]);
    strangers.visit(corner, reach, [&](std::uint32_t side, const NearestOnEdge& found) {
      if (!(found.share > 0 && found.share < 1)) return;
      const IndexTriangle& t = rims.triangles[side / 3];
      const std::uint32_t cluster = clusters.of(corner);
      const bool has_it = std::any_of(t.begin(), t.end(),
                                      [&](std::uint32_t p) { return clusters.of(p) == cluster; });
      if (!has_it) splits.push_back({side, found.share, corner});
    });
  }
  std::sort(splits.begin(), splits.end(), [](const EdgeSplit& a, const EdgeSplit& b) {
    return std::tie(a.side, a.share, a.corner) < std::tie(b.side, b.share, b.corner);
  });
  std::vector<EdgeSplit> different;
  for (const EdgeSplit& split : splits) {
    const auto is_same = [&](const EdgeSplit& other) {
      return other.side == split.side && clusters.of(other.corner) == clusters.of(split.corner);
    };
    // Those of one side are few.
    auto known = different.rbegin();
    while (known != different.rend() && known->side == split.side && !is_same(*known)) ++known;
    const bool is_known = known != different.rend() && is_same(*known);
    if (!is_known) different.push_back(split);
  }
  return different;
}

std::vector<IndexTriangle> split_triangle(const IndexTriangle& triangle, const EdgeSplit* first,
                                          const EdgeSplit* last) {
  Piece whole{triangle, {}};
  for (; first != last; ++first) whole.on_side[first->side % 3].push_back(first->corner);
  std::vector<Piece> open = {std::move(whole)};
  std::vector<IndexTriangle> pieces;
  while (!open.empty()) {
    Piece piece = std::move(open.back());
    open.pop_back();
    std::size_t k = 0;
    while (k < 3 && piece.on_side[k].empty()) ++k;
    if (k == 3) {
      pieces.push_back(piece.corners);
      continue;
    }
    const std::uint32_t from = piece.corners[k], to = piece.corners[(k + 1) % 3];
    const std::uint32_t apex = piece.corners[(k + 2) % 3];
    std::vector<std::uint32_t> line = {from};
    line.insert(line.end(), piece.on_side[k].begin(), piece.on_side[k].end());
    line.push_back(to);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      Piece part{{line[i], line[i + 1], apex}, {}};
      if (i + 2 == line.size()) part.on_side[1] = piece.on_side[(k + 1) % 3];
      if (i == 0) part.on_side[2] = piece.on_side[(k + 2) % 3];
      open.push_back(std::move(part));
    }
  }
  return pieces;
}

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
