// SPDX-License-Identifier: MIT
#include <algorithm>

#include <repair/solidity.h>

#include "solidity_system.h"

namespace meshrepair {

using internal::LinkTerm;

std::vector<double> solve_solidity(const CellGraph& graph, const SolveOptions& options,
                                   SolveReport& report, const std::vector<double>& start) {
  const auto term = [](const Link& link) {
    return LinkTerm{link.area, 1 - 2.0 * link.opacity, 0.0};
  };
  std::vector<double> s = internal::minimise(graph, term, -1, start, options, report);
  for (double& x : s) x = std::clamp(x, -1.0, 1.0);
  return s;
}

std::vector<double> solve_winding(const CellGraph& graph, const SolveOptions& options,
                                  SolveReport& report, const std::vector<double>& start) {
  const auto term = [](const Link& link) {
    return LinkTerm{link.area, 1.0, static_cast<double>(link.winding)};
  };
  return internal::minimise(graph, term, 0, start, options, report);
}

}  // namespace meshrepair
