// SPDX-License-Identifier: MIT
#include "check_complex.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>

namespace meshrepair::internal {
namespace {

void require(bool holds, const char* what, CellId cell) {
  if (holds) return;
  throw InternalError("internal error: in cell " + std::to_string(cell.value) + ", " + what);
}

struct CellElements {
  std::vector<VertexId> vertices;
  std::vector<std::pair<EdgeId, std::uint32_t>> directed_edges;  // as seen from outside
  std::size_t facets = 0;
};

void collect_facet(const CellComplex& complex, CellId cell, FacetId facet, CellElements& all) {
  const Facet& f = complex.facets[facet];
  require((f.above == cell) != (f.below == cell), "a facet is not on exactly one side", cell);
  const bool outward = f.below == cell;
  std::vector<VertexId> loop;
  complex.for_each_use(facet, [&](UseId u) {
    const Use& use = complex.uses[u];
    require(use.facet == facet, "a use names another facet than its loop", cell);
    require(complex.uses[use.next].previous == u, "a loop is not linked both ways", cell);
    require(complex.target(use) == complex.origin(complex.uses[use.next]), "a loop has a gap",
            cell);
    loop.push_back(complex.origin(use));
    all.directed_edges.emplace_back(use.edge(), outward ? use.reversed() : 1 - use.reversed());
  });
  all.vertices.insert(all.vertices.end(), loop.begin(), loop.end());
  require(loop.size() >= 2, "a loop has fewer than two vertices", cell);
  std::sort(loop.begin(), loop.end());
  require(std::adjacent_find(loop.begin(), loop.end()) == loop.end(), "a loop is not simple", cell);
  ++all.facets;
}

template <class Value>
std::size_t count_distinct(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values.size();
}

// All facets can be reached from the first one across edges: V - E + F = 2 alone allows a sphere
// and a torus.
void require_connected(const CellComplex& complex, CellId cell, std::size_t facets) {
  std::vector<FacetId> reached = {complex.cells[cell].first_facet};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    complex.for_each_use(reached[i], [&](UseId u) {
      const FacetId next = complex.uses[complex.mate(u, cell)].facet;
      if (std::find(reached.begin(), reached.end(), next) == reached.end()) reached.push_back(next);
    });
  }
  require(reached.size() == facets, "the surface is not connected", cell);
}

// What the other checks rely on: every reference is to something that is there, and every list
// ends.
void require_sound_references(const CellComplex& complex) {
  const auto require_all = [](bool holds, const char* what) {
    if (!holds) throw InternalError(std::string("internal error: ") + what);
  };
  for (const Edge& e : complex.edges) {
    require_all(complex.vertices.contains(e.ends[0]) && complex.vertices.contains(e.ends[1]),
                "an edge has an end that is no vertex");
    require_all(complex.uses.contains(e.first_use), "an edge is in no facet");
  }
  for (const Use& u : complex.uses) {
    require_all(complex.facets.contains(u.facet) && complex.edges.contains(u.edge()),
                "a use is of no facet or no edge");
    require_all(complex.uses.contains(u.next) && complex.uses.contains(u.previous),
                "a loop is not closed");
    require_all(!u.next_around.valid() || complex.uses.contains(u.next_around),
                "a ring goes on to no use");
  }
  for (const Facet& f : complex.facets) {
    require_all(complex.uses.contains(f.first_use), "a facet has no loop");
    require_all(f.above != f.below, "a facet has the same cell on both sides");
    for (const CellId c : {f.above, f.below}) {
      require_all(!c.valid() || complex.cells.contains(c), "a facet bounds no cell");
    }
    for (const FacetId next : {f.next_above, f.next_below}) {
      require_all(!next.valid() || complex.facets.contains(next), "a list goes on to no facet");
    }
  }
  for (const Cell& c : complex.cells) {
    require_all(complex.facets.contains(c.first_facet), "a cell has no facet");
  }
}

// The ring of uses around every edge: of that edge, and all in all every use once.
void require_rings(const CellComplex& complex) {
  std::size_t around = 0;
  for (EdgeId e(0u); e < complex.edges.end_id(); ++e.value) {
    for (UseId u = complex.edges[e].first_use; u.valid(); u = complex.uses[u].next_around) {
      require(complex.uses[u].edge() == e, "a use is in the ring of another edge", CellId(0u));
      require(++around <= complex.uses.size(), "a ring does not end", CellId(0u));
    }
  }
  require(around == complex.uses.size(), "a use is in no ring", CellId(0u));
}

// Every facet with the cell on one side can be reached from its list, which ends.
void require_lists(const CellComplex& complex) {
  std::size_t listed = 0;
  std::size_t sides = 0;
  for (const Facet& f : complex.facets) sides += f.above.valid() + f.below.valid();
  for (CellId c(0u); c < complex.cells.end_id(); ++c.value) {
    complex.for_each_facet(c, [&](FacetId f) {
      require(complex.bounds(f, c), "a facet of another cell is in the list", c);
      require(++listed <= sides, "a list of facets does not end", c);
    });
  }
  require(listed == sides, "the lists of cells and the sides of facets differ", CellId(0u));
}

// The first six facets are the sides of the box; what they are cut into stays in their planes.
void require_closed_box(const CellComplex& complex) {
  const auto on_box = [&](const Facet& f) {
    for (std::uint32_t side = 0; side < 6; ++side) {
      if (f.plane == complex.facets[FacetId(side)].plane) return true;
    }
    return false;
  };
  for (const Facet& f : complex.facets) {
    const CellId inside = f.above.valid() ? f.above : f.below;
    require(f.above.valid() && f.below.valid() ? !on_box(f) : on_box(f),
            "a facet is outside, but not on the box", inside);
  }
}

}  // namespace

void check_cell(const CellComplex& complex, CellId cell) {
  CellElements all;
  complex.for_each_facet(cell, [&](FacetId f) { collect_facet(complex, cell, f, all); });
  require(all.facets >= 2, "there are fewer than two facets", cell);
  const std::size_t uses = all.directed_edges.size();
  require(count_distinct(all.directed_edges) == uses, "an edge is passed twice in one direction",
          cell);
  for (std::size_t i = 0; i + 1 < uses; i += 2) {
    require(all.directed_edges[i].first == all.directed_edges[i + 1].first,
            "an edge is passed in one direction only", cell);
  }
  require(uses % 2 == 0, "an edge is passed in one direction only", cell);
  require(count_distinct(all.vertices) + all.facets == uses / 2 + 2, "V - E + F is not 2", cell);
  require_connected(complex, cell, all.facets);
}

void check_complex(const CellComplex& complex) {
  require_sound_references(complex);
  require_rings(complex);
  require_lists(complex);
  require_closed_box(complex);
  for (CellId c(0u); c < complex.cells.end_id(); ++c.value) check_cell(complex, c);
}

}  // namespace meshrepair::internal
