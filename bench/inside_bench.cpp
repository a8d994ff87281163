// How long does each inside rule take? With --missing as first argument, one triangle in twenty is
// left out, so that the optimisation has to run.
#include <cstring>
#include <memory>
#include <string>

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

std::unique_ptr<CellGraph> make_graph(const TriangleSoup& soup) {
  CleanReport clean;
  BuildTreeReport tree_report;
  const Tree tree = build_tree(clean_soup(soup, clean), {}, tree_report);
  ClipReport clip;
  CellComplex complex = build_cells(tree, {}, clip);
  CoverReport cover_report;
  const auto cover = cover_facets(complex, windings_of(tree.input), cover_report);
  return std::make_unique<CellGraph>(complex, cover);
}

}  // namespace

int main(int argc, char** argv) {
  const bool missing = argc > 1 && std::strcmp(argv[1], "--missing") == 0;
  if (missing) {
    --argc;
    ++argv;
  }
  for (const InsideRule rule : {InsideRule::parity, InsideRule::solidity, InsideRule::winding}) {
    bench::run_cases<std::unique_ptr<CellGraph>>(
        argc, argv, "label_cells, " + std::string(rule_name(rule)),
        [&](const TriangleSoup& soup) {
          return make_graph(missing ? testing::without_some(soup, 0.05, 1) : soup);
        },
        [&](std::unique_ptr<CellGraph>& graph) {
          InsideOptions options;
          options.rule = rule;
          InsideReport report;
          (void)label_cells(*graph, options, report);
          return std::to_string(graph->cells()) + " cells, " +
                 std::to_string(report.solve.iterations) + " iterations";
        });
  }
  return 0;
}
