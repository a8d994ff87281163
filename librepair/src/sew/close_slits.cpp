// SPDX-License-Identifier: MIT
#include "close_slits.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <bsp/internal/corners.h>
#include <mesh/edge_table.h>
#include <repair/orient_parts.h>

#include "line_edges.h"
#include "split_edges.h"

namespace meshrepair::internal {
namespace {

// Without a slit that would make a triangle twice, the next one may.
constexpr int kMostPasses = 8;

std::vector<LineEdge> find_open_edges(const CleanSoup& soup) {
  const std::vector<IndexTriangle> triangles = index_triangles(soup);
  std::vector<LineEdge> edges;
  EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() != 1) return;
    const std::uint32_t s = sides[0];
    edges.push_back(line_edge(soup, s, PointId(side_start(triangles, s)),
                              PointId(side_start(triangles, next_side(s)))));
  });
  sort_by_lines(edges);
  return edges;
}

struct Split {
  EdgeSplit at;
  std::uint32_t slit = 0;
};

// Whether each piece between two corners is of two edges at least, and there are few of them.
bool may_be_closed(std::span<const LineEdge> edges) {
  if (edges.size() < 2) return false;
  const Overlap slit(edges);
  const std::size_t pieces = slit.pieces();
  return pieces != edges.size() && pieces <= kMostPieces * edges.size() && slit.least_edges() >= 2;
}

// That may be closed. `edges` are sorted, and stay where they are.
std::vector<std::span<const LineEdge>> find_slits(const std::vector<LineEdge>& edges) {
  std::vector<std::span<const LineEdge>> slits;
  for_each_overlap(edges, [&](std::span<const LineEdge> slit) {
    if (may_be_closed(slit)) slits.push_back(slit);
  });
  return slits;
}

// A sheet that stands on a rim is none: at its corners other edges are open, too.
void leave_out_rims(const std::vector<LineEdge>& edges, std::size_t points,
                    std::vector<std::span<const LineEdge>>& slits) {
  if (slits.empty()) return;
  std::vector<std::uint32_t> others(points, 0);  // open edges at each point that are of no slit
  for (const LineEdge& edge : edges) {
    ++others[edge.at_low.index()];
    ++others[edge.at_high.index()];
  }
  for (const auto& slit : slits) {
    for (const LineEdge& edge : slit) {
      --others[edge.at_low.index()];
      --others[edge.at_high.index()];
    }
  }
  std::erase_if(slits, [&](const auto& slit) {
    return std::any_of(slit.begin(), slit.end(), [&](const LineEdge& edge) {
      return others[edge.at_low.index()] + others[edge.at_high.index()] > 0;
    });
  });
}

// By sides, and along these.
std::vector<Split> splits_of(const std::vector<std::span<const LineEdge>>& slits) {
  std::vector<Split> splits;
  for (std::uint32_t i = 0; i < slits.size(); ++i) {
    Overlap(slits[i]).for_each_split([&](const EdgeSplit& at) { splits.push_back({at, i}); });
  }
  std::sort(splits.begin(), splits.end(), [](const Split& a, const Split& b) {
    return std::tie(a.at.side, a.at.share) < std::tie(b.at.side, b.at.share);
  });
  return splits;
}

class SlitCloser {
 public:
  SlitCloser(CleanSoup& soup, ProgressObserver* progress) : soup_(soup), check_(progress) {}

  std::size_t run() {
    const std::vector<LineEdge> edges = find_open_edges(soup_);
    std::vector<std::span<const LineEdge>> slits = find_slits(edges);
    leave_out_rims(edges, soup_.points.size(), slits);
    splits_ = splits_of(slits);
    std::vector<char> refused(slits.size(), 0);
    for (int pass = 0; !splits_.empty(); ++pass) {
      if (pass == kMostPasses) return 0;
      check_.ask();
      make_pieces();
      if (!refuse_copies(refused)) break;
      std::erase_if(splits_, [&](const Split& split) { return refused[split.slit] != 0; });
    }
    if (splits_.empty()) return 0;
    put_in(soup_, pieces_);
    return static_cast<std::size_t>(std::count(refused.begin(), refused.end(), 0));
  }

 private:
  void make_pieces() {
    std::vector<EdgeSplit> at;
    for (const Split& split : splits_) at.push_back(split.at);
    pieces_ = split_triangles(soup_, at);
  }

  // No two triangles of a clean soup have the same corners: whether slits are not to be closed for
  // that.
  bool refuse_copies(std::vector<char>& refused) const {
    struct Piece {
      CornerIds corners;
      std::size_t of;  // pieces_.size(): of a triangle that stays
    };
    std::vector<Piece> all;
    std::vector<char> is_corner(soup_.points.size(), 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (const auto& [a, b, c] : pieces_[i].corners) {
        all.push_back({sorted_corners({PointId(a), PointId(b), PointId(c)}), i});
        is_corner[a] = is_corner[b] = is_corner[c] = 1;
      }
    }
    for (const Triangle& t : soup_.triangles) {
      const auto& c = t.corners;
      if (std::all_of(c.begin(), c.end(), [&](PointId p) { return is_corner[p.index()] != 0; })) {
        all.push_back({sorted_corners(c), pieces_.size()});
      }
    }
    std::sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) {
      return std::tie(a.corners, a.of) < std::tie(b.corners, b.of);
    });
    bool any = false;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      if (all[i].corners != all[i + 1].corners) continue;
      any = true;
      const TriangleInPieces& pieces = pieces_[all[i].of];
      for (std::size_t s = pieces.first_split; s < pieces.end_split; ++s) {
        refused[splits_[s].slit] = 1;
      }
    }
    return any;
  }

  CleanSoup& soup_;
  CancelCheck check_;
  std::vector<Split> splits_;
  std::vector<TriangleInPieces> pieces_;
};

}  // namespace

std::size_t close_slits(CleanSoup& soup, ProgressObserver* progress) {
  return SlitCloser(soup, progress).run();
}

namespace {

// Where all triangles are turned rightly they are a cycle: what runs along an edge one way and the
// other adds up to nothing. A triangle that has become a line is nothing, but its sides are: two of
// them lie on the third. So what is left of the sum at each edge adds up to nothing on each piece
// of each line, and cutting edges at the corners on them closes the surface again, exactly.

// So many are cut however few the edges are.
constexpr std::size_t kFewPieces = 1 << 20;

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
      edges.push_back(line_edge(soup, side, PointId(start(side)), PointId(start(next_side(side)))));
    }
  });
  sort_by_lines(edges);
  return edges;
}

std::vector<EdgeSplit> find_splits_at_corners(const std::vector<LineEdge>& edges) {
  std::vector<EdgeSplit> splits;
  for_each_overlap(edges, [&](std::span<const LineEdge> together) {
    const Overlap overlap(together);
    if (overlap.pieces() > std::max(kFewPieces, kMostPieces * together.size())) return;
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
    sum += same_orientation(first.corners, copy.corners) ? copy.layers : -copy.layers;
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
      all.push_back({sorted_corners(c), t});
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
  drop_cancelled(soup);
}

}  // namespace

bool zip_edges(CleanSoup& soup, ProgressObserver* progress) {
  drop_cancelled(soup);
  const std::vector<LineEdge> edges = find_unbalanced(soup, progress);
  if (edges.empty()) return true;
  const std::vector<EdgeSplit> splits = find_splits_at_corners(edges);
  if (splits.empty()) return false;
  const std::vector<TriangleInPieces> split = split_triangles(soup, splits);
  std::vector<char> is_marked(soup.points.size(), 0);
  for (const TriangleInPieces& in : split) {
    for (const IndexTriangle& piece : in.corners) {
      for (const std::uint32_t p : piece) is_marked[p] = 1;
    }
  }
  put_in(soup, split);
  merge_copies(soup, is_marked);
  return find_unbalanced(soup, progress).empty();
}

namespace {

bool is_cancelled(const Triangle& triangle) { return triangle.winding == 0; }

void drop_unused_points(CleanSoup& soup) {
  IdVector<PointId, char> is_used(soup.points.size(), 0);
  for (const Triangle& t : soup.triangles) {
    for (const PointId p : t.corners) is_used[p] = 1;
  }
  IdVector<PointId, PointId> becomes(soup.points.size());
  IdVector<PointId, Vec3d> points;
  IdVector<PointId, GridPoint> grid_points;
  for (PointId p(0u); p < soup.points.end_id(); ++p.value) {
    if (is_used[p] == 0) continue;
    becomes[p] = points.push_back(soup.points[p]);
    grid_points.push_back(soup.grid_points[p]);
  }
  for (Triangle& t : soup.triangles) {
    for (PointId& p : t.corners) p = becomes[p];
  }
  soup.points = std::move(points);
  soup.grid_points = std::move(grid_points);
}

}  // namespace

std::size_t drop_cancelled(CleanSoup& soup) {
  const auto& all = soup.triangles;
  const auto count = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_cancelled));
  if (count == 0) return 0;
  IdVector<TriangleId, Triangle> triangles;
  triangles.reserve(all.size() - count);
  for (const Triangle& t : all) {
    if (!is_cancelled(t)) triangles.push_back(t);
  }
  soup.triangles = std::move(triangles);
  drop_unused_points(soup);
  return count;
}

}  // namespace meshrepair::internal
