// How long does clipping all cells take, and how long finding what covers their facets?
#include <memory>
#include <string>

#include <bsp/build_tree.h>
#include <extract/build_cells.h>
#include <extract/cover_facets.h>
#include <repair/orient_parts.h>

#include "bench_cases.h"

using namespace meshrepair;

namespace {

struct Cells {
  std::unique_ptr<Tree> tree;
  std::unique_ptr<CellComplex> complex;
};

Cells make_tree_only(const TriangleSoup& soup) {
  CleanReport clean;
  BuildTreeReport report;
  return {std::make_unique<Tree>(build_tree(clean_soup(soup, clean), {}, report)), nullptr};
}

Cells make_cells(const TriangleSoup& soup) {
  Cells cells = make_tree_only(soup);
  ClipReport report;
  cells.complex = std::make_unique<CellComplex>(build_cells(*cells.tree, {}, report));
  return cells;
}

}  // namespace

int main(int argc, char** argv) {
  bench::run_cases<Cells>(argc, argv, "build_cells", make_tree_only, [](Cells& cells) {
    ClipReport report;
    const CellComplex complex = build_cells(*cells.tree, {}, report);
    return std::to_string(complex.cells.size()) + " cells, " +
           std::to_string(complex.facets.size()) + " facets, " +
           std::to_string(report.fallbacks()) + " fallbacks";
  });
  bench::run_cases<Cells>(argc, argv, "cover_facets", make_cells, [](Cells& cells) {
    CoverReport report;
    (void)cover_facets(*cells.complex, windings_of(cells.tree->input), report);
    return std::to_string(report.opaque_facets) + " opaque, " +
           std::to_string(report.split_facets) + " splits";
  });
  return 0;
}
