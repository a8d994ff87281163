// Where all triangles are turned rightly they are a cycle: what runs along an edge one way and the
// other adds up to nothing. A triangle that has become a line is nothing, but its sides are: two of
// them lie on the third. So what is left of the sum at each edge adds up to nothing on each piece
// of each line, and cutting edges at the corners on them closes the surface again, exactly.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <bsp/corners.h>
#include <mesh/edge_table.h>
#include <repair/orient_parts.h>
#include <repair/zip_edges.h>

#include "drop_cancelled.h"
#include "line_edges.h"
#include "split_triangles.h"

namespace meshrepair {
namespace {

// So many are cut however few the edges are.
constexpr std::size_t kFewPieces = 1 << 20;

using internal::CornerIds;
using internal::EdgeSplit;
using internal::LineEdge;
using internal::TriangleInPieces;

// All sides at edges along which more runs one way than the other, by their lines.
std::vector<LineEdge> find_unbalanced(const CleanSoup& soup, ProgressObserver* progress) {
  CancelCheck(progress).ask();
  const std::vector<IndexTriangle> triangles = index_triangles(soup);
  std::vector<LineEdge> edges;
  EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    const auto start = [&](std::uint32_t side) { return side_start(triangles, side); };
    std::int64_t sum = 0;
    for (const std::uint32_t side : sides) {
      const std::int64_t layers = soup.triangles[TriangleId(side / 3)].layers;
      sum += start(side) < start(next_side(side)) ? layers : -layers;
    }
    if (sum == 0) return;
    for (const std::uint32_t side : sides) {
      edges.push_back(
          internal::line_edge(soup, side, PointId(start(side)), PointId(start(next_side(side)))));
    }
  });
  internal::sort_by_lines(edges);
  return edges;
}

std::vector<EdgeSplit> find_splits_at_corners(const std::vector<LineEdge>& edges) {
  std::vector<EdgeSplit> splits;
  internal::for_each_overlap(edges, [&](std::span<const LineEdge> together) {
    const internal::Overlap overlap(together);
    if (overlap.pieces() > std::max(kFewPieces, internal::kMostPieces * together.size())) return;
    overlap.for_each_split([&](const EdgeSplit& split) { splits.push_back(split); });
  });
  std::sort(splits.begin(), splits.end(), [](const EdgeSplit& a, const EdgeSplit& b) {
    return std::tie(a.side, a.share) < std::tie(b.side, b.share);
  });
  return splits;
}

// Copies of one triangle: the first stands for all, the others cancel out.
void merge(CleanSoup& soup, std::span<const TriangleId> copies) {
  Triangle& first = soup.triangles[copies[0]];
  std::int32_t sum = first.layers;
  for (const TriangleId t : copies.subspan(1)) {
    Triangle& copy = soup.triangles[t];
    sum += internal::same_orientation(first.corners, copy.corners) ? copy.layers : -copy.layers;
    copy.winding = 0;
  }
  if (sum < 0) {
    std::swap(first.corners[1], first.corners[2]);
    first.winding = -first.winding;
  }
  if (sum == 0) first.winding = 0;
  first.layers = std::max(1, std::abs(sum));
}

// Of triangles whose corners are all marked.
void merge_copies(CleanSoup& soup, const std::vector<char>& is_marked) {
  std::vector<std::pair<CornerIds, TriangleId>> all;
  for (TriangleId t(0u); t.index() < soup.triangles.size(); ++t.value) {
    const CornerIds& c = soup.triangles[t].corners;
    if (std::all_of(c.begin(), c.end(), [&](PointId p) { return is_marked[p.index()] != 0; })) {
      all.push_back({internal::sorted_corners(c), t});
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<TriangleId> copies;
  for (std::size_t first = 0; first < all.size(); first += copies.size()) {
    copies.clear();
    for (std::size_t i = first; i < all.size() && all[i].first == all[first].first; ++i) {
      copies.push_back(all[i].second);
    }
    if (copies.size() > 1) merge(soup, copies);
  }
  internal::drop_cancelled(soup);
}

}  // namespace

bool zip_edges(CleanSoup& soup, ProgressObserver* progress) {
  internal::drop_cancelled(soup);
  const std::vector<LineEdge> edges = find_unbalanced(soup, progress);
  if (edges.empty()) return true;
  const std::vector<EdgeSplit> splits = find_splits_at_corners(edges);
  if (splits.empty()) return false;
  const std::vector<TriangleInPieces> split = internal::split_triangles(soup, splits);
  std::vector<char> is_marked(soup.points.size(), 0);
  for (const TriangleInPieces& in : split) {
    for (const IndexTriangle& piece : in.corners) {
      for (const std::uint32_t p : piece) is_marked[p] = 1;
    }
  }
  internal::put_in(soup, split);
  merge_copies(soup, is_marked);
  return find_unbalanced(soup, progress).empty();
}

}  // namespace meshrepair
