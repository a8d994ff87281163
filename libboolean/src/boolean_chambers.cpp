// SPDX-License-Identifier: MIT
#include "boolean_chambers.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <extract/arrange.h>
#include <repair/chamber_graph.h>
#include <repair/inside_rule.h>

#include "joined_solids.h"
#include "operands.h"

namespace meshrepair::internal {
namespace {

// Which chambers or cells the operation makes solid. What rounding to the common grid turned inside
// out, or laid over each other, is as small as that: it winds otherwise than solids do, and is
// solid where it winds around. Empty if `exact` is asked for and windings contradict each other.
std::vector<char> combine_regions(CellGraph& graph, std::span<const TriangleSoup> given,
                                  const JoinedSolids& solids, SetOperation operation, bool exact,
                                  const BooleanOptions& options) {
  InsideOptions inside;
  inside.rule = InsideRule::winding;
  inside.solve.progress = options.repair.progress;
  std::vector<Label> result;
  for (std::size_t k = 0; k < solids.solids(); ++k) {
    graph.set_windings(solids.windings(k));
    InsideReport report;
    const std::vector<char> solid = label_cells(graph, {}, inside, report).solid;
    if (exact && !report.exact) return {};
    const bool any = std::find(solid.begin(), solid.end(), 1) != solid.end();
    if (!any && !given[k].triangles.empty()) {
      throw_too_small(k, solids.soup().grid);
    }
    result.resize(solid.size());
    for (std::size_t c = 0; c < solid.size(); ++c) {
      const Label label = solid[c] != 0 ? Label::solid : Label::empty;
      result[c] = k == 0 ? label : combine(operation, result[c], label);
    }
  }
  std::vector<char> solid;
  solid.reserve(result.size());
  for (const Label label : result) solid.push_back(label == Label::solid ? 1 : 0);
  return solid;
}

}  // namespace

std::optional<Surface> boolean_by_chambers(std::span<const TriangleSoup> solids,
                                           SetOperation operation, const BooleanOptions& options,
                                           BooleanReport& report) {
  report = {};
  std::optional<JoinedSolids> joined;
  std::optional<Arrangement> arrangement;
  std::vector<char> solid;
  {
    StageMeter meter(report.result.stages, options.repair.progress);
    meter.begin("operands");
    joined = join_solids(solids, options, report);
    if (joined->soup().triangles.empty()) return Surface();
    meter.begin("arrange");
    arrangement = Arrangement::make(joined->soup(), report.result.arrange, options.repair.progress);
    if (!arrangement) return std::nullopt;
    meter.begin("inside");
    CellGraph graph = graph_of_chambers(*arrangement, joined->soup(), joined->orientation());
    solid = combine_regions(graph, solids, *joined, operation, true, options);
  }
  if (solid.empty()) return std::nullopt;
  if (std::find(solid.begin(), solid.end(), 1) == solid.end()) return Surface();
  return extract_mesh(joined->soup(), *arrangement, solid, options.repair, report.result);
}

Surface boolean_by_cells(std::span<const TriangleSoup> solids, SetOperation operation,
                         const BooleanOptions& options, BooleanReport& report) {
  report = {};
  std::optional<JoinedSolids> joined;
  {
    StageMeter meter(report.result.stages, options.repair.progress);
    meter.begin("operands");
    joined = join_solids(solids, options, report);
  }
  const auto combined = [&](CellGraph& graph) {
    return combine_regions(graph, solids, *joined, operation, false, options);
  };
  return extract_mesh(joined->soup(), combined, options.repair, report.result);
}

}  // namespace meshrepair::internal
