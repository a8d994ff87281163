#include "solidity_system.h"

#include <algorithm>
#include <utility>

#include <base/error.h>
#include <base/parallel.h>
#include <base/shared_progress.h>

#include "conjugate_gradients.h"

namespace meshrepair::internal {
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
                             const SolveOptions& options, SolveReport& report) {
  report = {};
  std::vector<double> x(graph.cells(), outside);
  const System system = assemble(graph, term, outside, options.progress);
  report.unknowns = system.cell_of_row.size();
  const std::vector<double> solution =
      solve_by_conjugate_gradients(system.matrix, system.right, options, report);
  for (std::size_t row = 0; row < solution.size(); ++row) {
    x[system.cell_of_row[row].index()] = solution[row];
  }
  return x;
}

}  // namespace meshrepair::internal
