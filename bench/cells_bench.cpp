// SPDX-License-Identifier: MIT
// cells_bench [MESH...]: how long does clipping all cells take, and how long finding what covers
// their facets? cells_bench --check [MESH...]: proves the invariants of the cells after each cut,
// with exact predicates and with floating ones.
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include <bsp/build_tree.h>
#include <extract/build_cells.h>
#include <extract/cover_facets.h>
#include <extract/float_engine.h>
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

// Throws InternalError where a cell is none.
std::string check_cells(const Tree& tree, PredicateEngine* engine) {
  BuildCellsOptions options;
  options.engine = engine;
  options.check_every_clip = true;
  ClipReport report;
  const CellComplex complex = build_cells(tree, options, report);
  return std::to_string(complex.cells.size()) + " cells, " + std::to_string(report.fallbacks()) +
         " fallbacks";
}

int check_all(int argc, char** argv) {
  try {
    for (const bench::Case& input : bench::cases_of(argc, argv)) {
      const Cells cells = make_tree_only(input.soup);
      FloatEngine floating(cells.tree->input, kDefaultEpsilon);
      const std::string exact = check_cells(*cells.tree, nullptr);
      std::printf("%s: exact: %s; floating: %s\n", input.name.c_str(), exact.c_str(),
                  check_cells(*cells.tree, &floating).c_str());
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cells_bench: %s\n", error.what());
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--check") return check_all(argc - 1, argv + 1);
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
