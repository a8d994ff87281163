// SPDX-License-Identifier: MIT
#include "winding_field.h"

#include <repair/solidity.h>
#include <repair/walk.h>

namespace meshrepair::internal {

std::vector<double> winding_field(const CellGraph& graph, const SolveOptions& options,
                                  InsideReport& report) {
  const Walk walk = walk_winding(graph, options.progress);
  report.exact = walk.consistent();
  report.contradictions = walk.contradictions;
  if (!walk.consistent()) return solve_winding(graph, options, report.solve);
  return {walk.value.begin(), walk.value.end()};
}

}  // namespace meshrepair::internal
