// SPDX-License-Identifier: MIT
// The two global optimisations: solidity (Murali and Funkhouser 1997) and winding.
#pragma once

#include <cstddef>
#include <vector>

#include <base/progress.h>
#include <repair/cell_graph.h>

namespace meshrepair {

struct SolveOptions {
  double tolerance = 1e-5;  // relative residual of the conjugate gradients
  int max_iterations = 5000;
  ProgressObserver* progress = nullptr;  // asked all the time whether to go on
};

struct SolveReport {
  std::size_t unknowns = 0;
  std::size_t iterations = 0;
  double residual = 0;  // relative, as estimated by the solver
  bool converged = true;
};

// Both begin with `start`, a value for each cell, or with 0 if there is none or it is no better:
// near the optimum they are done sooner.
//
// s of each cell in [-1, 1], -1 outside: the minimum of
//   sum over all links of (1 - o) A (s_i - s_j)^2 + o A (s_i + s_j)^2, o the opacity.
// Does not look at the triangles' orientation.
[[nodiscard]] std::vector<double> solve_solidity(const CellGraph& graph,
                                                 const SolveOptions& options, SolveReport& report,
                                                 const std::vector<double>& start = {});

// w of each cell, 0 outside: the minimum of the sum over links of A (w_below - w_above -
// winding)^2.
[[nodiscard]] std::vector<double> solve_winding(const CellGraph& graph, const SolveOptions& options,
                                                SolveReport& report,
                                                const std::vector<double>& start = {});

}  // namespace meshrepair
