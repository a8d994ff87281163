// SPDX-License-Identifier: MIT
// Cutting at singular edges and vertices.
//
// Steps: pair the sides of polygons along each edge of the complex (two sides: with each other;
// more: with the next boundary facet met when turning through solid cells, or through empty ones if
// what touches is to be joined). Join the corners that paired sides have in common. Each class of
// corners is one fan, and becomes one vertex.
#include <algorithm>
#include <utility>
#include <vector>

#include <base/assert.h>
#include <base/disjoint_sets.h>
#include <base/error.h>
#include <base/ids.h>
#include <extract/cut_nonmanifold.h>

namespace meshrepair {
namespace {

// The sides of polygons, listed by the edge of the complex that they run along.
class SidesByEdge {
 public:
  SidesByEdge(const CellComplex& complex, const Boundary& boundary)
      : first_(complex.edges.size(), kNone), next_(boundary.sides(), kNone) {
    for (auto s = static_cast<std::uint32_t>(boundary.sides()); s-- > 0;) {
      std::uint32_t& first = first_[complex.uses[boundary.use[s]].edge()];
      next_[s] = first;
      first = s;
    }
  }

  // For each edge the first of its sides; kNone for edges without.
  [[nodiscard]] const IdVector<EdgeId, std::uint32_t>& first() const { return first_; }
  [[nodiscard]] std::uint32_t next(std::uint32_t side) const { return next_[side]; }
  // More than two sides?
  [[nodiscard]] bool singular(std::uint32_t first) const {
    return first != kNone && next_[next_[first]] != kNone;
  }

 private:
  IdVector<EdgeId, std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
};

class NonmanifoldCutter {
 public:
  NonmanifoldCutter(const CellComplex& complex, const Boundary& boundary,
                    const std::vector<char>& solid, Touching touching, ProgressObserver* progress)
      : complex_(complex),
        boundary_(boundary),
        solid_(solid),
        wedge_is_solid_(touching == Touching::separate),
        cancel_(progress),
        sides_(complex, boundary),
        fans_(boundary.sides()) {}

  ManifoldCorners run() {
    pair_sides();
    join_corners();
    number_vertices();
    mark_ends_of_singular_edges();
    return std::move(result_);
  }

 private:
  void pair_sides() {
    result_.mate.assign(boundary_.sides(), kNone);
    for (const std::uint32_t first : sides_.first()) {
      cancel_.tick();
      if (first == kNone) continue;
      const std::uint32_t second = sides_.next(first);
      MESHREPAIR_ASSERT(second != kNone);
      if (!sides_.singular(first)) {
        join(first, second);
        continue;
      }
      ++result_.singular_edges;
      pair_sides_of_edge(first);
    }
  }

  void pair_sides_of_edge(std::uint32_t first) {
    list_uses_around(complex_.uses[boundary_.use[first]].edge());
    if (side_of_use_.empty()) side_of_use_ = IdVector<UseId, std::uint32_t>(complex_.uses.size());
    for (std::uint32_t s = first; s != kNone; s = sides_.next(s))
      side_of_use_[boundary_.use[s]] = s;
    std::uint32_t at_outside = kNone;
    for (std::uint32_t s = first; s != kNone; s = sides_.next(s)) {
      if (result_.mate[s] != kNone) continue;
      const UseId end = end_of_wedge(boundary_.use[s]);
      if (end.valid()) {
        join(s, side_along(end));
      } else if (at_outside == kNone) {
        at_outside = s;
      } else {
        join(s, at_outside);
        at_outside = kNone;
      }
    }
    // What lies outside the box is part of one empty wedge, which has two ends.
    MESHREPAIR_ASSERT(at_outside == kNone);
  }

  void join(std::uint32_t a, std::uint32_t b) {
    result_.mate[a] = b;
    result_.mate[b] = a;
  }

  // So that the other use of a cell is found at once, however many there are.
  void list_uses_around(EdgeId edge) {
    uses_of_cells_.clear();
    for (UseId u = complex_.edges[edge].first_use; u.valid(); u = complex_.uses[u].next_around) {
      const Facet& facet = complex_.facets[complex_.uses[u].facet];
      for (const CellId cell : {facet.below, facet.above}) {
        if (cell.valid()) uses_of_cells_.emplace_back(cell, u);
      }
    }
    std::sort(uses_of_cells_.begin(), uses_of_cells_.end());
  }

  // Each cell has two uses of the edge in hand.
  [[nodiscard]] UseId mate_in(CellId cell, UseId use) const {
    const auto found =
        std::lower_bound(uses_of_cells_.begin(), uses_of_cells_.end(), std::pair(cell, UseId(0u)));
    const auto mate =
        found != uses_of_cells_.end() && found->second == use ? std::next(found) : found;
    if (mate == uses_of_cells_.end() || mate->first != cell) {
      throw InternalError("internal error: an edge of a cell has only one facet");
    }
    return mate->second;
  }

  // Turns around the edge through the cells of a wedge until the next boundary facet. Invalid where
  // that leads out of the box.
  [[nodiscard]] UseId end_of_wedge(UseId use) {
    const Facet& start = complex_.facets[complex_.uses[use].facet];
    CellId cell = is_solid(start.above) == wedge_is_solid_ ? start.above : start.below;
    while (cell.valid()) {
      cancel_.tick();
      use = mate_in(cell, use);
      const Facet& facet = complex_.facets[complex_.uses[use].facet];
      cell = facet.above == cell ? facet.below : facet.above;
      if (is_solid(cell) != wedge_is_solid_) return use;
    }
    return {};
  }

  [[nodiscard]] bool is_solid(CellId cell) const {
    return cell.valid() && solid_[cell.index()] != 0;
  }

  // Of the edge in hand.
  [[nodiscard]] std::uint32_t side_along(UseId use) const {
    const std::uint32_t side = side_of_use_[use];
    if (side < boundary_.sides() && boundary_.use[side] == use) return side;
    throw InternalError("internal error: a wedge of cells does not end at a boundary facet");
  }

  void join_corners() {
    for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
      // A side starts where its mate ends.
      fans_.join(s, boundary_.next(result_.mate[s]));
    }
  }

  void number_vertices() {
    result_.vertex.resize(boundary_.sides());
    // For each vertex of the complex its first copy.
    std::vector<std::uint32_t> copy(complex_.vertices.size(), kNone);
    for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
      const std::uint32_t r = fans_.root(s);
      if (r != s) {
        result_.vertex[s] = result_.vertex[r];
        continue;
      }
      const auto added = static_cast<std::uint32_t>(result_.vertices());
      result_.vertex[s] = added;
      result_.vertex_corner.push_back(s);
      std::uint32_t& first = copy[corner_vertex(complex_, boundary_, s, solid_).index()];
      result_.singular.push_back(first != kNone ? 1 : 0);
      if (first == kNone) {
        first = added;
      } else if (result_.singular[first] == 0) {
        result_.singular[first] = 1;
        ++result_.singular_vertices;
      }
    }
  }

  void mark_ends_of_singular_edges() {
    result_.singular_side.assign(boundary_.sides(), 0);
    if (result_.singular_edges == 0) return;
    for (const std::uint32_t first : sides_.first()) {
      if (!sides_.singular(first)) continue;
      for (std::uint32_t s = first; s != kNone; s = sides_.next(s)) {
        result_.singular_side[s] = 1;
        result_.singular[result_.vertex[s]] = 1;
        result_.singular[result_.vertex[boundary_.next(s)]] = 1;
      }
    }
  }

  const CellComplex& complex_;
  const Boundary& boundary_;
  const std::vector<char>& solid_;
  bool wedge_is_solid_;
  CancelCheck cancel_;
  SidesByEdge sides_;
  std::vector<std::pair<CellId, UseId>> uses_of_cells_;  // around the edge in hand, sorted
  // Of the sides of singular edges met so far.
  IdVector<UseId, std::uint32_t> side_of_use_;
  DisjointSets fans_;
  ManifoldCorners result_;
};

}  // namespace

ManifoldCorners cut_nonmanifold(const CellComplex& complex, const Boundary& boundary,
                                const std::vector<char>& solid, Touching touching,
                                ProgressObserver* progress) {
  return NonmanifoldCutter(complex, boundary, solid, touching, progress).run();
}

namespace {

// Have two of the pairs of sides along an edge the same two end vertices?
bool pairs_share_ends(const Boundary& boundary, const ManifoldCorners& corners,
                      const SidesByEdge& sides, std::uint32_t first) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> taken;
  for (std::uint32_t s = first; s != kNone; s = sides.next(s)) {
    if (corners.mate[s] < s) continue;
    const std::pair<std::uint32_t, std::uint32_t> ends =
        std::minmax({corners.vertex[s], corners.vertex[boundary.next(s)]});
    taken.push_back(ends);
  }
  std::sort(taken.begin(), taken.end());
  return std::adjacent_find(taken.begin(), taken.end()) != taken.end();
}

}  // namespace

MiddleVertices separate_common_edges(const CellComplex& complex, const Boundary& boundary,
                                     const ManifoldCorners& corners) {
  MiddleVertices middles;
  if (corners.singular_edges == 0) return middles;
  middles.of_side.assign(boundary.sides(), kNone);
  const SidesByEdge sides(complex, boundary);
  for (const std::uint32_t first : sides.first()) {
    if (!sides.singular(first) || !pairs_share_ends(boundary, corners, sides, first)) continue;
    for (std::uint32_t s = first; s != kNone; s = sides.next(s)) {
      if (corners.mate[s] < s) continue;
      const auto middle = static_cast<std::uint32_t>(middles.count++);
      middles.of_side[s] = middles.of_side[corners.mate[s]] = middle;
    }
  }
  return middles;
}

}  // namespace meshrepair
