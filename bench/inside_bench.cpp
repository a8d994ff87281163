// SPDX-License-Identifier: MIT
// How long does each inside rule take? With --missing as first argument, one triangle in twenty is
// left out, so that the optimisation has to run.
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include <bsp/build_tree.h>
#include <extract/build_cells.h>
#include <extract/cover_facets.h>
#include <repair/cell_graph.h>
#include <repair/inside_rule.h>
#include <repair/orient_parts.h>

#include "bench_cases.h"
#include "shapes.h"

using namespace meshrepair;

namespace {

struct Labelling {
  Orientation orientation;
  std::unique_ptr<CellGraph> graph;
};

Labelling make_labelling(const TriangleSoup& soup) {
  CleanReport clean;
  BuildTreeReport tree_report;
  const Tree tree = build_tree(clean_soup(soup, clean), {}, tree_report);
  ClipReport clip;
  CellComplex complex = build_cells(tree, {}, clip);
  CoverReport cover_report;
  OrientReport orient_report;
  Orientation orientation = orient_parts(tree.input, orient_report);
  orientation.winding = windings_of(tree.input);
  const auto cover = cover_facets(complex, orientation.winding, cover_report);
  return {std::move(orientation), std::make_unique<CellGraph>(complex, cover)};
}

}  // namespace

int main(int argc, char** argv) {
  const bool missing = argc > 1 && std::strcmp(argv[1], "--missing") == 0;
  if (missing) {
    --argc;
    ++argv;
  }
  for (const InsideRule rule : {InsideRule::parity, InsideRule::solidity, InsideRule::winding}) {
    bench::run_cases<Labelling>(
        argc, argv, "label_cells, " + std::string(rule_name(rule)),
        [&](const TriangleSoup& soup) {
          return make_labelling(missing ? testing::without_some(soup, 0.05, 1) : soup);
        },
        [&](Labelling& labelling) {
          InsideOptions options;
          options.rule = rule;
          InsideReport report;
          (void)label_cells(*labelling.graph, labelling.orientation, options, report);
          return std::to_string(labelling.graph->cells()) + " cells, " +
                 std::to_string(report.solve.iterations) + " iterations";
        });
  }
  return 0;
}
