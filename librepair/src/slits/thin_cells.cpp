// SPDX-License-Identifier: MIT
// Idea: faces that nearly coincide, as those of a copy that was turned and turned back, leave a
// stack of thin cells, each with triangles on both sides. No cell of a stack may be better off
// alone on the other side. So all thin cells near the boundary are labelled at once: what is solid
// and what empty among them is a minimum cut, where a facet costs its area if it is boundary. Cells
// that are not thin are as they were, and what the cut starts from and ends at.
//
// Kept: a cell changes only if all of one of its broad sides is boundary, or borders a cell that
// changed; the widths up to there add up to what the boundary moves. What the cut wants farther
// away than allowed, or where nothing cuts the boundary, is made to stay, and all is cut again.
// Sets of changed cells that do not touch are each for the better, so any of them may be left out
// in the end.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include <repair/thin_cells.h>

#include "common/minimum_cut.h"
#include "thin_cell_graph.h"

namespace meshrepair {
namespace {

using internal::CutNode;
using internal::ThinCellGraph;
using Node = ThinCellGraph::Node;

// How much farther than the width of a cell the boundary may move, over several of them.
constexpr double kReach = 2;

// Of the volume: if more would go with what becomes empty, that is no fin but what there is.
constexpr double kMostFins = 0.1;

// In grid units, what only open parts surround and is not wider counts for nothing: a sheet may be
// as thick when its points are put on the grid.
constexpr double kSheet = 2;

// The last round leaves out what is still wanted and must not be.
constexpr int kMostRounds = 8;

constexpr double kFarCells = std::numeric_limits<double>::infinity();

class ThinCells {
 public:
  ThinCells(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
            const ThinCellsOptions& options, std::vector<char>& solid)
      : complex_(complex),
        cover_(cover),
        options_(options),
        solid_(solid),
        cancel_(options.progress),
        graph_(complex, cover, options, solid),
        nodes_(graph_.nodes()),
        changes_(nodes_.size()) {}

  // Nothing changed if the report says so.
  ThinCellsReport run() {
    if (nodes_.empty()) return {};
    for (int round = 1; find_wanted(); ++round) {
      find_reached();
      const bool is_stable = make_stay();
      if (!is_stable && round < kMostRounds) continue;
      if (!is_stable) leave_out_unreached();
      change_reached();
      break;
    }
    return emptied_volume_ <= kMostFins * volume_at_first() ? report_ : ThinCellsReport{};
  }

 private:
  // Of a node.
  struct Change {
    bool wanted = false;
    double moved = kFarCells;  // how far the boundary moves if the cell changes; far: it must not
  };

  // What changes with the minimum cut; false: nothing.
  bool find_wanted() {
    std::vector<CutNode> costs = graph_.costs();
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (!nodes_[n].stays) continue;
      (graph_.is_solid(nodes_[n].cell) ? costs[n].out : costs[n].in) = internal::kForbidden;
    }
    const std::vector<char> solid = internal::minimum_cut(costs, graph_.edges());
    bool is_any = false;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      changes_[n].wanted = (solid[n] != 0) != graph_.is_solid(nodes_[n].cell);
      changes_[n].moved = kFarCells;
      is_any = is_any || changes_[n].wanted;
    }
    return is_any;
  }

  // The nearest to the boundary first.
  void find_reached() {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto enqueue = [&](std::uint32_t n) {
      if (!changes_[n].wanted || changes_[n].moved < kFarCells) return;
      const double distance = distance_to_boundary(nodes_[n]);
      if (distance <= kReach * options_.within) queue.emplace(distance, n);
    };
    reached_.clear();
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) enqueue(n);
    while (!queue.empty()) {
      cancel_.tick();
      const double distance = queue.top().first;
      const std::uint32_t n = queue.top().second;
      queue.pop();
      if (changes_[n].moved < kFarCells) continue;
      changes_[n].moved = distance;
      reached_.push_back(n);
      complex_.for_each_facet(nodes_[n].cell, [&](FacetId f) {
        const std::uint32_t other = graph_.node_of(graph_.across(f, nodes_[n].cell));
        if (other < ThinCellGraph::kWide) enqueue(other);
      });
    }
  }

  // Of any point of the cell, from where the boundary was at first, along the direction across: all
  // of one broad side is boundary, or was moved. Far if that is true of neither, and where nothing
  // cuts the boundary.
  [[nodiscard]] double distance_to_boundary(const Node& node) {
    std::array<double, 2> moved{0, 0};
    std::array<bool, 2> is_there{false, false};
    bool may_go = false;
    for (const ThinCellGraph::Side& side : graph_.sides_of(node)) {
      const bool bounds = graph_.is_boundary(side.facet);
      const std::uint32_t other = graph_.node_of(side.other);
      const double moved_there = other < ThinCellGraph::kWide ? changes_[other].moved : kFarCells;
      may_go = may_go || (bounds && graph_.is_cut(side.facet)) || moved_there < kFarCells;
      if (std::abs(side.facing) < internal::kBroad) continue;
      const std::size_t which = side.facing > 0 ? 0 : 1;
      is_there[which] = true;
      moved[which] = std::max(moved[which], bounds ? 0 : moved_there);
    }
    double best = kFarCells;
    for (const std::size_t which : {std::size_t{0}, std::size_t{1}}) {
      if (may_go && is_there[which]) best = std::min(best, moved[which] + node.width.width);
    }
    return best;
  }

  // Whatever is wanted and must not be; true: nothing is.
  bool make_stay() {
    bool is_stable = true;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const Change& change = changes_[n];
      if (!change.wanted) continue;
      if (change.moved < kFarCells) continue;
      nodes_[n].stays = true;
      is_stable = false;
    }
    return is_stable;
  }

  // With all that is connected with it through cells that are wanted.
  void leave_out_unreached() {
    std::vector<std::uint32_t> queue;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      if (changes_[n].wanted && nodes_[n].stays) queue.push_back(n);
    }
    for (const std::uint32_t n : queue) changes_[n].wanted = false;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const CellId cell = nodes_[queue[next]].cell;
      complex_.for_each_facet(cell, [&](FacetId f) {
        const std::uint32_t other = graph_.node_of(graph_.across(f, cell));
        if (other >= ThinCellGraph::kWide || !changes_[other].wanted) return;
        changes_[other].wanted = false;
        queue.push_back(other);
      });
    }
    std::erase_if(reached_, [&](std::uint32_t n) { return !changes_[n].wanted; });
  }

  void change_reached() {
    for (const std::uint32_t n : reached_) {
      const CellId cell = nodes_[n].cell;
      double gain = 0;
      complex_.for_each_facet(cell, [&](FacetId f) {
        const double area = facet_area(complex_, f);
        gain += graph_.is_boundary(f) ? area : -area;
      });
      change(nodes_[n], gain);
    }
    share_gain();
  }

  void change(const Node& node, double gain) {
    char& solid = solid_[node.cell.index()];
    if (solid == 0) {
      ++report_.filled;
      report_.filled_area += gain;
    } else {
      ++report_.emptied;
      if (!is_in_sheet(node)) {
        report_.emptied_area += gain;
        emptied_volume_ += cell_volume(complex_, node.cell);
      }
    }
    solid = solid == 0 ? 1 : 0;
  }

  [[nodiscard]] bool is_in_sheet(const Node& node) const {
    if (options_.open.empty() || node.width.width > kSheet) return false;
    bool only_open = true;
    complex_.for_each_facet(node.cell, [&](FacetId f) {
      const TriangleId t = cover_[f].triangle;
      only_open = only_open && (!t.valid() || options_.open[t.index()] != 0);
    });
    return only_open;
  }

  // What one kind costs is for the sake of the other one.
  void share_gain() {
    const double sum = report_.filled_area + report_.emptied_area;
    if (report_.filled_area < 0) report_.emptied_area = sum;
    if (report_.emptied_area < 0) report_.filled_area = sum;
    report_.filled_area = std::max(0.0, report_.filled_area);
    report_.emptied_area = std::max(0.0, report_.emptied_area);
  }

  // Of what was solid at first; looked at only where something became empty.
  [[nodiscard]] double volume_at_first() const {
    double volume = emptied_volume_;
    if (emptied_volume_ == 0) return volume;
    std::vector<char> changed(solid_.size(), 0);
    for (const std::uint32_t n : reached_) changed[nodes_[n].cell.index()] = 1;
    for (CellId c(0u); c < complex_.cells.end_id(); ++c.value) {
      const bool was_solid = graph_.is_solid(c) && changed[c.index()] == 0;
      if (was_solid) volume += cell_volume(complex_, c);
    }
    return volume;
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  const ThinCellsOptions& options_;
  std::vector<char>& solid_;
  CancelCheck cancel_;
  ThinCellGraph graph_;
  std::vector<Node>& nodes_;
  std::vector<Change> changes_;
  std::vector<std::uint32_t> reached_;  // of what is wanted, in the order in which it changes
  double emptied_volume_ = 0;
  ThinCellsReport report_;
};

}  // namespace

ThinCellsReport relabel_thin_cells(const CellComplex& complex,
                                   const IdVector<FacetId, Cover>& cover,
                                   const ThinCellsOptions& options, std::vector<char>& solid) {
  std::vector<char> changed = solid;
  const ThinCellsReport report = ThinCells(complex, cover, options, changed).run();
  if (report.filled + report.emptied > 0) solid = std::move(changed);
  return report;
}

}  // namespace meshrepair
