// The sparse system of a quadratic energy over the cells, those outside fixed.
#pragma once

#include <repair/cell_graph.h>
#include <repair/solidity.h>

namespace meshrepair::internal {

// One link's share of the energy: weight * (x_below - sign * x_above - jump)^2 with sign 1 or -1,
// or with jump 0 a mean of both.
struct LinkTerm {
  double weight = 0;
  double sign = 1;
  double jump = 0;
};

// Minimises the sum of term(link) with x = `outside` in the unbounded cells. The matrix is
// symmetric and positive definite because every cell is linked, through others, to an unbounded
// one.
[[nodiscard]] std::vector<double> minimise(const CellGraph& graph, LinkTerm (*term)(const Link&),
                                           double outside, const SolveOptions& options,
                                           SolveReport& report);

}  // namespace meshrepair::internal
