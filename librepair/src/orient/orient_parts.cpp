// SPDX-License-Identifier: MIT
// Orientation of parts.
//
// Idea: a piece, connected through edges with exactly two triangles, can only be turned as a whole,
// and its area votes for one of the two ways. Pieces meet at crowded edges, those with more
// than two triangles. Where their number is even, the surface is taken to bound a wedge between
// each triangle and the next one around the edge, so neighbours are turned against each other: a
// bond. A clean soup may break bonds (wedges that overlap), so they bind only pieces that have no
// say of their own; between others they only tell what belongs together. A piece that is closed at
// an edge by itself needs none there.
#include <algorithm>
#include <cmath>
#include <utility>

#include <base/ids.h>
#include <mesh/edge_table.h>
#include <repair/orient_parts.h>

#include "common/edge_fan.h"
#include "surface_pieces.h"
#include "turn_sets.h"

namespace meshrepair {
namespace {

using internal::SurfacePiece;
using internal::SurfacePieces;
using internal::SurfaceSum;
using internal::TurnSets;

double turned_share(const SurfaceSum& sum) {
  return sum.kept > 0 ? sum.turned / (sum.kept + sum.turned) : 1;
}

bool says_which_way(const SurfaceSum& sum) { return turned_share(sum) <= kBelievedShare; }

// The pieces that have a say of their own.
std::vector<char> firm_pieces(const std::vector<SurfacePiece>& pieces) {
  std::vector<char> firm;
  firm.reserve(pieces.size());
  for (const SurfacePiece& piece : pieces) {
    firm.push_back(says_which_way(piece.sum) ? 1 : 0);
  }
  return firm;
}

class PartOrienter {
 public:
  PartOrienter(const CleanSoup& soup, OrientReport& report, ProgressObserver* progress)
      : soup_(soup),
        report_(report),
        check_(progress),
        triangles_(index_triangles(soup)),
        table_(triangles_),
        pieces_(internal::find_pieces(soup, triangles_, table_, progress)),
        open_(pieces_.pieces.size(), 0),
        wall_(pieces_.pieces.size(), 0) {}

  Orientation run() {
    look_at_edges();
    TurnSets sets(firm_pieces(pieces_.pieces));
    bind(sets);
    gather(sets);
    count_crowded_edges();
    for (std::size_t p = 0; p < result_.parts.size(); ++p) decide(p);
    turn_triangles();
    return std::move(result_);
  }

 private:
  struct Bond {
    std::uint32_t a, b;
    std::int32_t votes;  // for leaving them as they are, less those for turning one
  };

  void look_at_edges() {
    table_.for_each_edge([&](std::span<const std::uint32_t> sides) {
      check_.tick();
      if (sides.size() == 1) {
        ++open_[pieces_.of[sides[0] / 3]];
      } else if (sides.size() > 2) {
        crowded_.emplace_back(sides.begin(), sides.end());
      }
    });
    find_walls();
    for (const auto& sides : crowded_) find_bonds(sides);
  }

  // A piece that is there both ways round and is an open sheet, or at one that is not, is a wall:
  // both sides of it are inside, or neither.
  void find_walls() {
    const auto& pieces = pieces_.pieces;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      wall_[p] = pieces[p].doubled && open_[p] > 0 && !pieces[p].sum.nearly_closed();
    }
    for (const auto& sides : crowded_) {
      const bool none_else = std::all_of(sides.begin(), sides.end(), [&](std::uint32_t s) {
        const SurfacePiece& piece = pieces[pieces_.of[s / 3]];
        return piece.doubled || piece.closes_holes;
      });
      if (none_else) continue;
      for (const std::uint32_t s : sides) {
        const std::uint32_t p = pieces_.of[s / 3];
        if (pieces[p].doubled) wall_[p] = 1;
      }
    }
  }

  void find_bonds(std::vector<std::uint32_t> sides) {
    std::erase_if(sides, [&](std::uint32_t s) { return wall_[pieces_.of[s / 3]] != 0; });
    if (sides.empty() || sides.size() % 2 != 0) return;
    if (!internal::sort_around_edge(soup_, triangles_, sides)) return;
    std::vector<std::uint32_t> here;
    here.reserve(sides.size());
    for (const std::uint32_t s : sides) here.push_back(pieces_.of[s / 3]);
    std::sort(here.begin(), here.end());
    // Whether an odd number of the sides are the piece's.
    const auto ends_here = [&](std::uint32_t piece) {
      const auto [first, last] = std::equal_range(here.begin(), here.end(), piece);
      return (last - first) % 2 != 0;
    };
    for (std::size_t i = 0; i < sides.size(); ++i) {
      check_.tick();
      const std::uint32_t s = sides[i];
      const std::uint32_t t = sides[(i + 1) % sides.size()];
      const std::uint32_t a = pieces_.of[s / 3];
      const std::uint32_t b = pieces_.of[t / 3];
      if (a == b || !ends_here(a) || !ends_here(b)) continue;
      bonds_.push_back({std::min(a, b), std::max(a, b), runs_up(s) != runs_up(t) ? 1 : -1});
    }
  }

  // Whether the triangle, as it is turned, passes the edge towards the point with the higher index.
  [[nodiscard]] bool runs_up(std::uint32_t side) const {
    const bool up = side_start(triangles_, side) < side_start(triangles_, next_side(side));
    return up != (pieces_.turned[side / 3] != 0);
  }

  // The bonds on which most edges agree come first.
  void bind(TurnSets& sets) {
    const auto ends = [](const Bond& bond) { return std::pair(bond.a, bond.b); };
    std::sort(bonds_.begin(), bonds_.end(),
              [&](const Bond& x, const Bond& y) { return ends(x) < ends(y); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < bonds_.size(); ++i) {
      if (kept > 0 && ends(bonds_[kept - 1]) == ends(bonds_[i])) {
        bonds_[kept - 1].votes += bonds_[i].votes;
      } else {
        bonds_[kept++] = bonds_[i];
      }
    }
    bonds_.resize(kept);
    std::stable_sort(bonds_.begin(), bonds_.end(), [](const Bond& x, const Bond& y) {
      return std::abs(x.votes) > std::abs(y.votes);
    });
    for (const Bond& bond : bonds_) {
      if (bond.votes != 0) sets.join(bond.a, bond.b, bond.votes < 0);
    }
  }

  // Makes a part of each set of pieces.
  void gather(TurnSets& sets) {
    const auto& pieces = pieces_.pieces;
    std::vector<std::uint32_t> part_of_root(pieces.size(), kNone);
    for (std::uint32_t p = 0; p < pieces.size(); ++p) {
      const TurnSets::Place place = sets.find(p);
      std::uint32_t& part = part_of_root[place.root];
      if (part == kNone) {
        part = static_cast<std::uint32_t>(result_.parts.size());
        result_.parts.emplace_back();
        sums_.emplace_back();
        part_open_.push_back(0);
      }
      part_.push_back(part);
      turn_.push_back(place.turned ? 1 : 0);
      sums_[part].add(place.turned ? pieces[p].sum.turned_round() : pieces[p].sum);
      part_open_[part] += open_[p];
      report_.unorientable_parts += !pieces[p].orientable;
    }
    report_.parts = result_.parts.size();
  }

  // Such an edge is open for the parts that have an odd number of triangles there.
  void count_crowded_edges() {
    std::vector<std::uint32_t> parts;
    for (const auto& sides : crowded_) {
      parts.clear();
      for (const std::uint32_t s : sides) parts.push_back(part_[pieces_.of[s / 3]]);
      std::sort(parts.begin(), parts.end());
      for (auto first = parts.begin(); first != parts.end();) {
        const auto last = std::upper_bound(first, parts.end(), *first);
        part_open_[*first] += (last - first) % 2 != 0;
        first = last;
      }
    }
  }

  void decide(std::size_t p) {
    OrientedPart& part = result_.parts[p];
    SurfaceSum& sum = sums_[p];
    bool turn = sum.turned > sum.kept;
    if (turn) sum = sum.turned_round();
    part.turned_share = turned_share(sum);
    part.believed = says_which_way(sum);
    part.closed = part_open_[p] == 0;
    part.shell = part.closed || sum.nearly_closed();
    if (part.shell) part.outward = sum.outward();
    if (!part.believed && part.outward < 0) {
      part.outward = 1;
      turn = !turn;
    }
    turn_part_.push_back(turn ? 1 : 0);
    report_.doubtful_parts += !part.believed;
  }

  void turn_triangles() {
    result_.winding.reserve(soup_.triangles.size());
    result_.part_of.reserve(soup_.triangles.size());
    for (TriangleId t(0u); t < soup_.triangles.end_id(); ++t.value) {
      check_.tick();
      const std::uint32_t piece = pieces_.of[t.value];
      const std::uint32_t part = part_[piece];
      const bool turn =
          (pieces_.turned[t.value] != 0) ^ (turn_[piece] != 0) ^ (turn_part_[part] != 0);
      std::int32_t winding = soup_.triangles[t].winding;
      if (wall_[piece] == 0) {
        winding = internal::side_of_corners(soup_, t) * (turn ? -1 : 1) * soup_.triangles[t].layers;
      }
      report_.turned_triangles += winding * soup_.triangles[t].winding < 0;
      result_.winding.push_back(winding);
      result_.part_of.push_back(part);
    }
  }

  const CleanSoup& soup_;
  OrientReport& report_;
  CancelCheck check_;
  std::vector<IndexTriangle> triangles_;
  EdgeTable table_;
  SurfacePieces pieces_;
  // Of each piece.
  std::vector<std::size_t> open_;  // edges
  std::vector<char> wall_, turn_;
  std::vector<std::uint32_t> part_;
  // Of each part.
  std::vector<SurfaceSum> sums_;
  std::vector<std::size_t> part_open_;  // edges
  std::vector<char> turn_part_;
  std::vector<std::vector<std::uint32_t>> crowded_;  // sides at edges with more than two
  std::vector<Bond> bonds_;
  Orientation result_;
};

}  // namespace

Orientation orient_parts(const CleanSoup& soup, OrientReport& report, ProgressObserver* progress) {
  report = {};
  return PartOrienter(soup, report, progress).run();
}

IdVector<TriangleId, std::int32_t> windings_of(const CleanSoup& soup) {
  IdVector<TriangleId, std::int32_t> winding;
  winding.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) winding.push_back(t.winding * t.layers);
  return winding;
}

std::vector<IndexTriangle> index_triangles(const CleanSoup& soup) {
  std::vector<IndexTriangle> triangles;
  triangles.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) {
    triangles.push_back({t.corners[0].value, t.corners[1].value, t.corners[2].value});
  }
  return triangles;
}

}  // namespace meshrepair
