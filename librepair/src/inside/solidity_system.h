// SPDX-License-Identifier: MIT
// The sparse system of a quadratic energy over the cells, those outside fixed, and its solution by
// conjugate gradients with a diagonal preconditioner, on several threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <repair/cell_graph.h>
#include <repair/solidity.h>

namespace meshrepair::internal {

// A sparse matrix by rows. Row i has the entries first[i] ... last[i] - 1; between rows there may
// be room that is not used.
struct SparseRows {
  std::vector<std::uint32_t> first, last;
  std::unique_ptr<std::uint32_t[]> column;  // NOLINT(modernize-avoid-c-arrays): not initialised
  std::unique_ptr<double[]> value;          // NOLINT(modernize-avoid-c-arrays)

  [[nodiscard]] std::size_t size() const { return first.size(); }
};

// The x with matrix * x = right, from `start` on, or from 0 if that is hardly worse, until the
// residual has become `options.tolerance` of that of 0. The matrix is symmetric and positive
// definite, and has its diagonal among its entries. Sums are made of the sums of blocks of rows, in
// their order: the result does not depend on the number of threads.
[[nodiscard]] std::vector<double> solve_by_conjugate_gradients(const SparseRows& matrix,
                                                               const std::vector<double>& right,
                                                               std::vector<double> start,
                                                               const SolveOptions& options,
                                                               SolveReport& report);

// One link's share of the energy: weight * (x_below - sign * x_above - jump)^2 with sign 1 or -1,
// or with jump 0 a mean of both.
struct LinkTerm {
  double weight = 0;
  double sign = 1;
  double jump = 0;
};

// Minimises the sum of term(link) with x = `outside` in the unbounded cells, from `start` on, which
// has a value for each cell or is empty. The matrix is
// symmetric and positive definite because every cell is linked, through others, to an unbounded
// one.
[[nodiscard]] std::vector<double> minimise(const CellGraph& graph, LinkTerm (*term)(const Link&),
                                           double outside, const std::vector<double>& start,
                                           const SolveOptions& options, SolveReport& report);

}  // namespace meshrepair::internal
