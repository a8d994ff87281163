#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <bsp/corners.h>
#include <mesh/edge_table.h>
#include <repair/close_slits.h>
#include <repair/orient_parts.h>

#include "line_edges.h"
#include "split_triangles.h"

namespace meshrepair {
namespace {

using internal::EdgeSplit;
using internal::LineEdge;
using internal::Overlap;
using internal::TriangleInPieces;

// Without a slit that would make a triangle twice, the next one may.
constexpr int kMostPasses = 8;

std::vector<LineEdge> find_open_edges(const CleanSoup& soup) {
  const std::vector<IndexTriangle> triangles = index_triangles(soup);
  std::vector<LineEdge> edges;
  EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() != 1) return;
    const std::uint32_t s = sides[0];
    edges.push_back(internal::line_edge(soup, s, PointId(side_start(triangles, s)),
                                        PointId(side_start(triangles, next_side(s)))));
  });
  internal::sort_by_lines(edges);
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
  return pieces != edges.size() && pieces <= internal::kMostPieces * edges.size() &&
         slit.least_edges() >= 2;
}

// That may be closed. `edges` are sorted, and stay where they are.
std::vector<std::span<const LineEdge>> find_slits(const std::vector<LineEdge>& edges) {
  std::vector<std::span<const LineEdge>> slits;
  internal::for_each_overlap(edges, [&](std::span<const LineEdge> slit) {
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
    internal::put_in(soup_, pieces_);
    return static_cast<std::size_t>(std::count(refused.begin(), refused.end(), 0));
  }

 private:
  void make_pieces() {
    std::vector<EdgeSplit> at;
    for (const Split& split : splits_) at.push_back(split.at);
    pieces_ = internal::split_triangles(soup_, at);
  }

  // No two triangles of a clean soup have the same corners: whether slits are not to be closed for
  // that.
  bool refuse_copies(std::vector<char>& refused) const {
    struct Piece {
      internal::CornerIds corners;
      std::size_t of;  // pieces_.size(): of a triangle that stays
    };
    std::vector<Piece> all;
    std::vector<char> is_corner(soup_.points.size(), 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (const auto& [a, b, c] : pieces_[i].corners) {
        all.push_back({internal::sorted_corners({PointId(a), PointId(b), PointId(c)}), i});
        is_corner[a] = is_corner[b] = is_corner[c] = 1;
      }
    }
    for (const Triangle& t : soup_.triangles) {
      const auto& c = t.corners;
      if (std::all_of(c.begin(), c.end(), [&](PointId p) { return is_corner[p.index()] != 0; })) {
        all.push_back({internal::sorted_corners(c), pieces_.size()});
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

}  // namespace meshrepair
