// SPDX-License-Identifier: MIT
#include "covered_cells.h"

#include <optional>
#include <utility>

#include <bsp/build_tree.h>
#include <extract/build_cells.h>

namespace meshrepair::internal {

Tree divide_space(CleanSoup clean, const RepairOptions& options, RepairReport& report,
                  StageMeter& meter) {
  meter.begin("tree");
  BuildTreeOptions tree_options = options.tree;
  tree_options.progress = options.progress;
  return build_tree(std::move(clean), tree_options, report.tree);
}

CoveredCells make_cells(const Tree& tree, const IdVector<TriangleId, std::int32_t>& winding,
                        const RepairOptions& options, RepairReport& report, StageMeter& meter) {
  meter.begin("cells");
  BuildCellsOptions cell_options;
  cell_options.check_every_clip = options.check_cells;
  cell_options.progress = options.progress;
  std::optional<FloatEngine> engine;
  report.predicates = options.predicates;
  if (options.predicates == Predicates::floating) {
    report.epsilon = options.epsilon;
    cell_options.engine = &engine.emplace(tree.input, options.epsilon);
  }
  CoveredCells covered{build_cells(tree, cell_options, report.clip), {}, {}};
  report.cells = covered.complex.cells.size();
  meter.begin("cover");
  // Only `automatic` turns parts, and asks what else lies on a facet.
  auto* layers = options.inside.rule == InsideRule::automatic ? &covered.layers : nullptr;
  covered.cover = cover_facets(covered.complex, winding, report.cover, options.progress, layers);
  report.facets = covered.complex.facets.size();
  return covered;
}

}  // namespace meshrepair::internal
