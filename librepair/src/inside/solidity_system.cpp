// SPDX-License-Identifier: MIT
#include "solidity_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <base/error.h>
#include <base/parallel.h>
#include <base/shared_progress.h>

namespace meshrepair::internal {
namespace {

// The rows of a task: some tens of microseconds of work. Changing it changes the rounding of sums.
constexpr std::size_t kRowsPerBlock = 4096;

// A start pays, and does no harm to the last digits, if its residual is less than this share of
// that of 0.
constexpr double kMuchNearer = 0.1;

// Memory is what the solver waits for, so each turn passes over the vectors three times only: the
// product with the matrix and how far to go, then that step and the new residual, then the next
// direction.
class Solver {
 public:
  Solver(const SparseRows& matrix, const std::vector<double>& right, std::vector<double> start,
         const SolveOptions& options)
      : matrix_(matrix),
        options_(options),
        x_(std::move(start)),
        residual_(right),
        direction_(right.size()),
        product_(right.size()),
        scale_(right.size()),
        sums_(tasks_of(right.size(), kRowsPerBlock)) {}

  std::vector<double> run(SolveReport& report) {
    const Sums of_zero = begin();
    if (of_zero.norm == 0) {
      x_.assign(residual_.size(), 0);
      return std::move(x_);
    }
    const Sums first = begin_with_start(of_zero);
    const double goal = std::max(options_.tolerance * options_.tolerance * of_zero.norm,
                                 std::numeric_limits<double>::min());
    double norm = first.norm;
    double slope = first.slope;
    const auto most = static_cast<std::size_t>(options_.max_iterations);
    std::size_t i = 0;
    for (; norm >= goal && i < most; ++i) {
      if (options_.progress != nullptr && options_.progress->cancelled()) throw Cancelled();
      const Sums next = step(slope / multiply());
      norm = next.norm;
      if (norm < goal) break;
      turn(next.slope / slope);
      slope = next.slope;
    }
    report.iterations = i;
    report.residual = std::sqrt(norm / of_zero.norm);
    report.converged = report.residual <= options_.tolerance;
    return std::move(x_);
  }

 private:
  struct Sums {
    double norm = 0;   // of the squares of the residual
    double slope = 0;  // of the squares, scaled
  };

  // The sum of what sum_of(first, last) gives for each block of rows.
  template <class SumOf>
  Sums add_up(const SumOf& sum_of) {
    parallel_tasks(residual_.size(), kRowsPerBlock,
                   [&](std::size_t task, std::size_t first, std::size_t last) {
                     sums_[task] = sum_of(first, last);
                   });
    Sums all;
    for (const Sums& part : sums_) {
      all.norm += part.norm;
      all.slope += part.slope;
    }
    return all;
  }

  Sums begin() {
    return add_up([&](std::size_t first, std::size_t last) {
      Sums part;
      for (std::size_t i = first; i < last; ++i) {
        scale_[i] = 1;
        for (std::uint32_t k = matrix_.first[i]; k < matrix_.last[i]; ++k) {
          if (matrix_.column[k] == i && matrix_.value[k] != 0) scale_[i] = 1 / matrix_.value[k];
        }
        direction_[i] = scale_[i] * residual_[i];
        part.norm += residual_[i] * residual_[i];
        part.slope += residual_[i] * direction_[i];
      }
      return part;
    });
  }

  // After begin(): the residual of the start, and where to go from there, if that is much nearer
  // than 0.
  Sums begin_with_start(const Sums& of_zero) {
    if (!x_.empty()) {
      direction_.swap(x_);
      multiply();
      direction_.swap(x_);
      const Sums of_start = add_up([&](std::size_t first, std::size_t last) {
        Sums part;
        for (std::size_t i = first; i < last; ++i) {
          const double rest = residual_[i] - product_[i];
          const double square = rest * rest;
          part.norm += square;
          part.slope += scale_[i] * square;
        }
        return part;
      });
      if (of_start.norm < kMuchNearer * kMuchNearer * of_zero.norm) {
        for (std::size_t i = 0; i < x_.size(); ++i) {
          residual_[i] -= product_[i];
          direction_[i] = scale_[i] * residual_[i];
        }
        return of_start;
      }
    }
    x_.assign(residual_.size(), 0);
    return of_zero;
  }

  // The matrix times the direction; returns what that is along the direction.
  double multiply() {
    const double* value = matrix_.value.get();
    const std::uint32_t* column = matrix_.column.get();
    const auto sum_of = [&](std::size_t first, std::size_t last) {
      Sums part;
      for (std::size_t i = first; i < last; ++i) {
        double sum = 0;
        const std::uint32_t end = matrix_.last[i];
        for (std::uint32_t k = matrix_.first[i]; k < end; ++k) {
          sum += value[k] * direction_[column[k]];
        }
        product_[i] = sum;
        part.slope += sum * direction_[i];
      }
      return part;
    };
    return add_up(sum_of).slope;
  }

  // Goes this far; returns the sums of the new residual.
  Sums step(double far) {
    return add_up([&](std::size_t first, std::size_t last) {
      Sums part;
      for (std::size_t i = first; i < last; ++i) {
        x_[i] += far * direction_[i];
        residual_[i] -= far * product_[i];
        const double square = residual_[i] * residual_[i];
        part.norm += square;
        part.slope += scale_[i] * square;
      }
      return part;
    });
  }

  void turn(double share) {
    parallel_tasks(x_.size(), kRowsPerBlock, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        direction_[i] = scale_[i] * residual_[i] + share * direction_[i];
      }
    });
  }

  const SparseRows& matrix_;
  const SolveOptions& options_;
  std::vector<double> x_, residual_, direction_, product_;
  std::vector<double> scale_;  // one over the diagonal
  std::vector<Sums> sums_;     // of each block
};

}  // namespace

std::vector<double> solve_by_conjugate_gradients(const SparseRows& matrix,
                                                 const std::vector<double>& right,
                                                 std::vector<double> start,
                                                 const SolveOptions& options, SolveReport& report) {
  return Solver(matrix, right, std::move(start), options).run(report);
}

namespace {

constexpr std::size_t kRowsPerTask = 2048;

struct System {
  std::vector<std::uint32_t> row_of_cell;  // kNone: fixed
  std::vector<CellId> cell_of_row;
  SparseRows matrix;
  std::vector<double> right;
};

// Each row has room for its links, and the diagonal.
void number_rows(const CellGraph& graph, System& system) {
  system.row_of_cell.assign(graph.cells(), kNone);
  std::size_t room = 0;
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
    if (graph.unbounded(c)) continue;
    system.row_of_cell[c.index()] = static_cast<std::uint32_t>(system.cell_of_row.size());
    system.cell_of_row.push_back(c);
    system.matrix.first.push_back(static_cast<std::uint32_t>(room));
    room += graph.links_of(c).size() + 1;
  }
  const std::size_t rows = system.cell_of_row.size();
  system.matrix.last.resize(rows);
  system.matrix.column = std::make_unique_for_overwrite<std::uint32_t[]>(room);
  system.matrix.value = std::make_unique_for_overwrite<double[]>(room);
  system.right.resize(rows);
}

// Half the derivative of the energy by x of this cell. The entries of one row are sorted, and those
// of links to the same neighbour added up.
void add_row(const CellGraph& graph, LinkTerm (*term)(const Link&), double outside,
             std::uint32_t row, System& system,
             std::vector<std::pair<std::uint32_t, double>>& entries) {
  const CellId cell = system.cell_of_row[row];
  entries.assign(1, {row, 0.0});
  double right = 0;
  for (const std::uint32_t l : graph.links_of(cell)) {
    const Link& link = graph.links()[l];
    const LinkTerm t = term(link);
    entries[0].second += t.weight;
    right += t.weight * t.jump * (link.below == cell ? 1 : -t.sign);
    const std::uint32_t other = system.row_of_cell[other_end(link, cell).index()];
    if (other == kNone) {
      right += t.weight * t.sign * outside;
    } else {
      entries.emplace_back(other, -t.weight * t.sign);
    }
  }
  std::sort(entries.begin(), entries.end());
  SparseRows& matrix = system.matrix;
  std::uint32_t end = matrix.first[row];
  for (const auto& [column, value] : entries) {
    if (end > matrix.first[row] && matrix.column[end - 1] == column) {
      matrix.value[end - 1] += value;
    } else {
      matrix.column[end] = column;
      matrix.value[end++] = value;
    }
  }
  matrix.last[row] = end;
  system.right[row] = right;
}

System assemble(const CellGraph& graph, LinkTerm (*term)(const Link&), double outside,
                ProgressObserver* progress) {
  System system;
  number_rows(graph, system);
  const std::size_t rows = system.cell_of_row.size();
  CancelOnly quiet(progress);
  SharedProgress shared(&quiet, tasks_of(rows, kRowsPerTask));
  parallel_tasks(rows, kRowsPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
    std::vector<std::pair<std::uint32_t, double>> entries;
    for (std::size_t row = first; row < last; ++row) {
      add_row(graph, term, outside, static_cast<std::uint32_t>(row), system, entries);
    }
    shared.done();
  });
  return system;
}

}  // namespace

std::vector<double> minimise(const CellGraph& graph, LinkTerm (*term)(const Link&), double outside,
                             const std::vector<double>& start, const SolveOptions& options,
                             SolveReport& report) {
  report = {};
  std::vector<double> x(graph.cells(), outside);
  const System system = assemble(graph, term, outside, options.progress);
  report.unknowns = system.cell_of_row.size();
  std::vector<double> start_of_rows;
  if (!start.empty()) {
    for (const CellId c : system.cell_of_row) start_of_rows.push_back(start[c.index()]);
  }
  const std::vector<double> solution = solve_by_conjugate_gradients(
      system.matrix, system.right, std::move(start_of_rows), options, report);
  for (std::size_t row = 0; row < solution.size(); ++row) {
    x[system.cell_of_row[row].index()] = solution[row];
  }
  return x;
}

}  // namespace meshrepair::internal
