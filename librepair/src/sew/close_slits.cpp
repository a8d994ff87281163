#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <mesh/edge_table.h>
#include <repair/close_slits.h>
#include <repair/orient_parts.h>

#include "split_edges.h"

namespace meshrepair {
namespace {

using internal::EdgeSplit;

// Where more corners are on an edge, on average, edges and corners are many, and pieces would be
// the product of both.
constexpr std::size_t kMostPieces = 16;

// Without a slit that would make a triangle twice, the next one may.
constexpr int kMostPasses = 8;

using Vector = std::array<std::int64_t, 3>;

// The same for all edges on one line. Grid coordinates have 27 bits, so moments have less than 60.
struct Line {
  Vector direction{};  // without a common divisor; the first number that is not 0 is above 0
  Vector moment{};
  auto operator<=>(const Line&) const = default;  // NOLINT(modernize-use-nullptr)
};

struct OpenEdge {
  Line line;
  std::int64_t low = 0, high = 0;  // along the line: a coordinate
  PointId at_low, at_high;
  std::uint32_t side = 0;  // 3 t + k
  bool is_reversed = false;
};

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector vector_of(const GridPoint& p) { return {p.x, p.y, p.z}; }

OpenEdge open_edge(const CleanSoup& soup, std::uint32_t side, PointId from, PointId to) {
  const Vector a = vector_of(soup.grid_points[from]), b = vector_of(soup.grid_points[to]);
  Vector way = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const std::int64_t divisor = std::gcd(std::gcd(way[0], way[1]), way[2]);
  std::size_t axis = 0;
  while (way[axis] == 0) ++axis;
  OpenEdge edge;
  edge.side = side;
  edge.is_reversed = way[axis] < 0;
  for (std::int64_t& x : way) x /= edge.is_reversed ? -divisor : divisor;
  edge.line = {way, cross(a, way)};
  edge.low = a[axis], edge.high = b[axis];
  edge.at_low = from, edge.at_high = to;
  if (edge.is_reversed) {
    std::swap(edge.low, edge.high);
    std::swap(edge.at_low, edge.at_high);
  }
  return edge;
}

// By their lines, and by their places on these.
std::vector<OpenEdge> find_open_edges(const CleanSoup& soup) {
  const std::vector<IndexTriangle> triangles = index_triangles(soup);
  std::vector<OpenEdge> edges;
  EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() != 1) return;
    const std::uint32_t s = sides[0];
    edges.push_back(open_edge(soup, s, PointId(side_start(triangles, s)),
                              PointId(side_start(triangles, next_side(s)))));
  });
  std::sort(edges.begin(), edges.end(), [](const OpenEdge& a, const OpenEdge& b) {
    return std::tie(a.line, a.low, a.side) < std::tie(b.line, b.low, b.side);
  });
  return edges;
}

struct Split {
  EdgeSplit at;
  std::uint32_t slit = 0;
};

// Edges of one line, each of which has more than a corner in common with those before.
class Slit {
 public:
  explicit Slit(std::span<const OpenEdge> edges) : edges_(edges) {
    for (const OpenEdge& edge : edges) {
      corners_.push_back({edge.low, edge.at_low});
      corners_.push_back({edge.high, edge.at_high});
    }
    std::sort(corners_.begin(), corners_.end());
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  }

  // Whether each piece between two corners is of two edges at least, and there are few of them.
  [[nodiscard]] bool may_be_closed() const {
    std::vector<int> change(corners_.size(), 0);  // of how many edges pieces are
    std::size_t pieces = 0;
    for (const OpenEdge& edge : edges_) {
      ++change[place_of(edge.low)];
      --change[place_of(edge.high)];
      pieces += place_of(edge.high) - place_of(edge.low);
    }
    if (pieces == edges_.size() || pieces > kMostPieces * edges_.size()) return false;
    int count = 0;
    for (std::size_t i = 0; i + 1 < change.size(); ++i) {
      count += change[i];
      if (count < 2) return false;
    }
    return true;
  }

  void add_splits(std::uint32_t slit, std::vector<Split>& splits) const {
    for (const OpenEdge& edge : edges_) {
      const auto length = static_cast<double>(edge.high - edge.low);
      for (std::size_t i = place_of(edge.low) + 1; corners_[i].first < edge.high; ++i) {
        const std::int64_t from_start =
            edge.is_reversed ? edge.high - corners_[i].first : corners_[i].first - edge.low;
        splits.push_back(
            {{edge.side, static_cast<double>(from_start) / length, corners_[i].second.value},
             slit});
      }
    }
  }

 private:
  [[nodiscard]] std::size_t place_of(std::int64_t at) const {
    const auto place = std::lower_bound(corners_.begin(), corners_.end(), at,
                                        [](const auto& c, std::int64_t x) { return c.first < x; });
    return static_cast<std::size_t>(place - corners_.begin());
  }

  std::span<const OpenEdge> edges_;
  std::vector<std::pair<std::int64_t, PointId>> corners_;  // along the line
};

// That may be closed. `edges` are sorted, and stay where they are.
std::vector<std::span<const OpenEdge>> find_slits(const std::vector<OpenEdge>& edges) {
  std::vector<std::span<const OpenEdge>> slits;
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t end = first + 1;
    std::int64_t high = edges[first].high;
    while (end < edges.size() && edges[end].line == edges[first].line && edges[end].low < high) {
      high = std::max(high, edges[end++].high);
    }
    const auto slit = std::span(edges).subspan(first, end - first);
    if (slit.size() > 1 && Slit(slit).may_be_closed()) slits.push_back(slit);
    first = end;
  }
  return slits;
}

// A sheet that stands on a rim is none: at its corners other edges are open, too.
void leave_out_rims(const std::vector<OpenEdge>& edges, std::size_t points,
                    std::vector<std::span<const OpenEdge>>& slits) {
  if (slits.empty()) return;
  std::vector<std::uint32_t> others(points, 0);  // open edges at each point that are of no slit
  for (const OpenEdge& edge : edges) {
    ++others[edge.at_low.index()];
    ++others[edge.at_high.index()];
  }
  for (const auto& slit : slits) {
    for (const OpenEdge& edge : slit) {
      --others[edge.at_low.index()];
      --others[edge.at_high.index()];
    }
  }
  std::erase_if(slits, [&](const auto& slit) {
    return std::any_of(slit.begin(), slit.end(), [&](const OpenEdge& edge) {
      return others[edge.at_low.index()] + others[edge.at_high.index()] > 0;
    });
  });
}

// By sides, and along these.
std::vector<Split> splits_of(const std::vector<std::span<const OpenEdge>>& slits) {
  std::vector<Split> splits;
  for (std::uint32_t i = 0; i < slits.size(); ++i) Slit(slits[i]).add_splits(i, splits);
  std::sort(splits.begin(), splits.end(), [](const Split& a, const Split& b) {
    return std::tie(a.at.side, a.at.share) < std::tie(b.at.side, b.at.share);
  });
  return splits;
}

std::array<PointId, 3> in_order(std::array<PointId, 3> corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

// A triangle in pieces.
struct Pieces {
  TriangleId triangle;
  std::size_t first_split = 0, last_split = 0;
  std::vector<IndexTriangle> corners;
};

class SlitCloser {
 public:
  SlitCloser(CleanSoup& soup, ProgressObserver* progress) : soup_(soup), check_(progress) {}

  std::size_t run() {
    const std::vector<OpenEdge> edges = find_open_edges(soup_);
    std::vector<std::span<const OpenEdge>> slits = find_slits(edges);
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
    put_in();
    return static_cast<std::size_t>(std::count(refused.begin(), refused.end(), 0));
  }

 private:
  void make_pieces() {
    pieces_.clear();
    std::vector<EdgeSplit> at;
    for (const Split& split : splits_) at.push_back(split.at);
    for (std::size_t first = 0; first < at.size();) {
      const TriangleId t(at[first].side / 3);
      std::size_t end = first;
      while (end < at.size() && at[end].side / 3 == t.value) ++end;
      const auto& [a, b, c] = soup_.triangles[t].corners;
      pieces_.push_back({t, first, end,
                         internal::split_triangle({a.value, b.value, c.value}, &at[first],
                                                  &at[first] + (end - first))});
      first = end;
    }
  }

  // No two triangles of a clean soup have the same corners: whether slits are not to be closed for
  // that.
  bool refuse_copies(std::vector<char>& refused) const {
    struct Piece {
      std::array<PointId, 3> corners;
      std::size_t of;  // pieces_.size(): of a triangle that stays
    };
    std::vector<Piece> all;
    std::vector<char> is_corner(soup_.points.size(), 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (const auto& [a, b, c] : pieces_[i].corners) {
        all.push_back({in_order({PointId(a), PointId(b), PointId(c)}), i});
        is_corner[a] = is_corner[b] = is_corner[c] = 1;
      }
    }
    for (const Triangle& t : soup_.triangles) {
      const auto& c = t.corners;
      if (std::all_of(c.begin(), c.end(), [&](PointId p) { return is_corner[p.index()] != 0; })) {
        all.push_back({in_order(c), pieces_.size()});
      }
    }
    std::sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) {
      return std::tie(a.corners, a.of) < std::tie(b.corners, b.of);
    });
    bool any = false;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      if (all[i].corners != all[i + 1].corners) continue;
      any = true;
      const Pieces& pieces = pieces_[all[i].of];
      for (std::size_t s = pieces.first_split; s < pieces.last_split; ++s) {
        refused[splits_[s].slit] = 1;
      }
    }
    return any;
  }

  void put_in() {
    IdVector<TriangleId, Triangle> triangles;
    std::size_t more = 0;
    for (const Pieces& pieces : pieces_) more += pieces.corners.size() - 1;
    triangles.reserve(soup_.triangles.size() + more);
    auto pieces = pieces_.begin();
    for (TriangleId t(0u); t.index() < soup_.triangles.size(); ++t.value) {
      if (pieces == pieces_.end() || pieces->triangle != t) {
        triangles.push_back(soup_.triangles[t]);
        continue;
      }
      Triangle piece = soup_.triangles[t];
      for (const auto& [a, b, c] : pieces->corners) {
        piece.corners = {PointId(a), PointId(b), PointId(c)};
        triangles.push_back(piece);
      }
      ++pieces;
    }
    soup_.triangles = std::move(triangles);
  }

  CleanSoup& soup_;
  CancelCheck check_;
  std::vector<Split> splits_;
  std::vector<Pieces> pieces_;
};

}  // namespace

std::size_t close_slits(CleanSoup& soup, ProgressObserver* progress) {
  return SlitCloser(soup, progress).run();
}

}  // namespace meshrepair
