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
  std::vector<double> walked(walk.value.begin(), walk.value.end());
  return walk.consistent() ? walked : solve_winding(graph, options, report.solve, walked);
}

}  // namespace meshrepair::internal
