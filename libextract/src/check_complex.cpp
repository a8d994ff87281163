#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <bsp/error.h>
#include <extract/check_complex.h>

namespace meshrepair {
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
    all.directed_edges.emplace_back(use.edge, outward ? use.reversed : 1 - use.reversed);
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
  std::size_t listed = 0;
  for (CellId c(0u); c < complex.cells.end_id(); ++c.value) {
    check_cell(complex, c);
    complex.for_each_facet(c, [&](FacetId) { ++listed; });
  }
  std::size_t sides = 0;
  for (const Facet& f : complex.facets) sides += f.above.valid() + f.below.valid();
  require(listed == sides, "the lists of cells and the sides of facets differ", CellId(0u));
  std::size_t around = 0;
  for (EdgeId e(0u); e < complex.edges.end_id(); ++e.value) {
    for (UseId u = complex.edges[e].first_use; u.valid(); u = complex.uses[u].next_around) {
      require(complex.uses[u].edge == e, "a use is in the ring of another edge", CellId(0u));
      ++around;
    }
  }
  require(around == complex.uses.size(), "a use is in no ring", CellId(0u));
}

}  // namespace meshrepair
