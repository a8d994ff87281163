#include "solidity_system.h"

#include <algorithm>
#include <utility>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <base/error.h>

namespace meshrepair::internal {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

constexpr int kFixed = -1;

// The diagonal preconditioner, asked once in each iteration: the place to notice that nobody waits
// any more.
class CancellablePreconditioner : public Eigen::DiagonalPreconditioner<double> {
 public:
  void observe(ProgressObserver* progress) { progress_ = progress; }

  template <class Right>
  Eigen::Solve<Eigen::DiagonalPreconditioner<double>, Right> solve(
      const Eigen::MatrixBase<Right>& right) const {
    if (progress_ != nullptr && progress_->cancelled()) throw Cancelled();
    return Eigen::DiagonalPreconditioner<double>::solve(right);
  }

 private:
  ProgressObserver* progress_ = nullptr;
};

struct System {
  std::vector<int> row_of_cell;
  std::vector<CellId> cell_of_row;
  std::vector<int> first, column;
  std::vector<double> value;
  Eigen::VectorXd right;
};

void number_rows(const CellGraph& graph, System& system) {
  system.row_of_cell.assign(graph.cells(), kFixed);
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
    if (graph.unbounded(c)) continue;
    system.row_of_cell[c.index()] = static_cast<int>(system.cell_of_row.size());
    system.cell_of_row.push_back(c);
  }
}

// Half the derivative of the energy by x of this cell. The entries of one row are sorted, and those
// of links to the same neighbour added up.
void add_row(const CellGraph& graph, LinkTerm (*term)(const Link&), double outside, CellId cell,
             System& system, std::vector<std::pair<int, double>>& entries) {
  const int row = system.row_of_cell[cell.index()];
  entries.assign(1, {row, 0.0});
  double right = 0;
  for (const std::uint32_t l : graph.links_of(cell)) {
    const Link& link = graph.links()[l];
    const LinkTerm t = term(link);
    entries[0].second += t.weight;
    right += t.weight * t.jump * (link.below == cell ? 1 : -t.sign);
    const int other = system.row_of_cell[other_end(link, cell).index()];
    if (other == kFixed) {
      right += t.weight * t.sign * outside;
    } else {
      entries.emplace_back(other, -t.weight * t.sign);
    }
  }
  std::sort(entries.begin(), entries.end());
  system.first.push_back(static_cast<int>(system.column.size()));
  for (const auto& [column, value] : entries) {
    if (system.column.size() > static_cast<std::size_t>(system.first.back()) &&
        system.column.back() == column) {
      system.value.back() += value;
    } else {
      system.column.push_back(column);
      system.value.push_back(value);
    }
  }
  system.right[row] = right;
}

System assemble(const CellGraph& graph, LinkTerm (*term)(const Link&), double outside,
                ProgressObserver* progress) {
  System system;
  number_rows(graph, system);
  system.right.resize(static_cast<Eigen::Index>(system.cell_of_row.size()));
  system.column.reserve(2 * graph.links().size() + graph.cells());
  system.value.reserve(2 * graph.links().size() + graph.cells());
  std::vector<std::pair<int, double>> entries;
  CancelCheck check(progress);
  for (const CellId c : system.cell_of_row) {
    check.tick();
    add_row(graph, term, outside, c, system, entries);
  }
  system.first.push_back(static_cast<int>(system.column.size()));
  return system;
}

}  // namespace

std::vector<double> minimise(const CellGraph& graph, LinkTerm (*term)(const Link&), double outside,
                             const SolveOptions& options, SolveReport& report) {
  report = {};
  std::vector<double> x(graph.cells(), outside);
  const System system = assemble(graph, term, outside, options.progress);
  const auto n = static_cast<Eigen::Index>(system.cell_of_row.size());
  report.unknowns = system.cell_of_row.size();
  if (n == 0) return x;
  const Eigen::Map<const Matrix> matrix(n, n, static_cast<Eigen::Index>(system.value.size()),
                                        system.first.data(), system.column.data(),
                                        system.value.data());
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, CancellablePreconditioner> solver;
  solver.preconditioner().observe(options.progress);
  solver.setTolerance(options.tolerance);
  solver.setMaxIterations(options.max_iterations);
  solver.compute(matrix);
  const Eigen::VectorXd solution = solver.solve(system.right);
  report.iterations = static_cast<std::size_t>(solver.iterations());
  report.residual = solver.error();
  report.converged = solver.info() == Eigen::Success;
  for (Eigen::Index row = 0; row < n; ++row) {
    x[system.cell_of_row[static_cast<std::size_t>(row)].index()] = solution[row];
  }
  return x;
}

}  // namespace meshrepair::internal
