// Memory is what the solver waits for, so each turn passes over the vectors three times only: the
// product with the matrix and how far to go, then that step and the new residual, then the next
// direction.
#include "conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/error.h>
#include <base/parallel.h>

namespace meshrepair::internal {
namespace {

// The rows of a task: some tens of microseconds of work. Changing it changes the rounding of sums.
constexpr std::size_t kRowsPerBlock = 4096;

class Solver {
 public:
  Solver(const SparseRows& matrix, const std::vector<double>& right, const SolveOptions& options)
      : matrix_(matrix),
        options_(options),
        x_(right.size(), 0),
        residual_(right),
        direction_(right.size()),
        product_(right.size()),
        scale_(right.size()),
        sums_(tasks_of(right.size(), kRowsPerBlock)) {}

  std::vector<double> run(SolveReport& report) {
    const Sums start = begin();
    if (start.norm == 0) return std::move(x_);
    const double goal = std::max(options_.tolerance * options_.tolerance * start.norm,
                                 std::numeric_limits<double>::min());
    double norm = start.norm;
    double slope = start.slope;
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
    report.residual = std::sqrt(norm / start.norm);
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
    parallel_tasks(x_.size(), kRowsPerBlock,
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
                                                 const SolveOptions& options, SolveReport& report) {
  return Solver(matrix, right, options).run(report);
}

}  // namespace meshrepair::internal
