// SPDX-License-Identifier: MIT
#include "outer_pockets.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace meshrepair::internal {
namespace {

// Thinner than this share of its width, a pocket is a sliver: about what is left where one strip of
// a surface is laid over the next. A cube has 0.14, a plate ten times as wide as thick 0.06 ...
constexpr double kSliver = 0.01;
// ... and a fold has less than this share of the area that its part bounds solid with, all folds of
// a part together less than that one.
constexpr double kSmall = 0.01;
constexpr double kFew = 0.05;

// A patch that closes a hole is smaller than the surface around it; with this share of that and
// more, a pocket is what a patch cuts off.
constexpr double kMostPatched = 0.75;

using PartOf = IdVector<TriangleId, std::uint32_t>;

struct Pocket {
  std::vector<CellId> cells;
  double area = 0, volume = 0;
  double given = 0, closing = 0;  // area of its outside: of the input, and of anything else
  // Of the parts around it, the one that bounds most solid, and the area that it does so with.
  std::uint32_t part = 0;
  double solid_area = 0;
};

bool is_negative(double x) { return x < -0.5; }
bool is_solid(double x) { return x > 0.5; }

class PocketFinder {
 public:
  PocketFinder(const CellGraph& graph, const PartOf& part_of, const std::vector<double>& solid_area,
               const std::vector<double>& w)
      : graph_(graph),
        part_of_(part_of),
        solid_area_(solid_area),
        w_(w),
        is_in_one_(graph.cells(), 0) {
    find_cells();
    remaining_ = is_in_one_;
  }

  [[nodiscard]] bool is_new(CellId cell) const { return remaining_[cell.index()] != 0; }

  // The one with this cell.
  Pocket take(CellId first) {
    Pocket pocket;
    pocket.cells.push_back(first);
    remaining_[first.index()] = 0;
    for (std::size_t i = 0; i < pocket.cells.size(); ++i) {
      const CellId cell = pocket.cells[i];
      pocket.volume += graph_.volume(cell);
      for (const std::uint32_t l : graph_.links_of(cell)) look_at(graph_.links()[l], cell, pocket);
    }
    return pocket;
  }

 private:
  // The cells of negative winding that are reached from outside through empty ones and each other.
  void find_cells() {
    std::vector<char> seen(graph_.cells(), 0);
    std::vector<CellId> queue;
    for (CellId c(0u); c.index() < graph_.cells(); ++c.value) {
      if (!graph_.unbounded(c)) continue;
      seen[c.index()] = 1;
      queue.push_back(c);
    }
    // From empty cells into empty and negative ones, from those into negative ones only.
    while (!queue.empty()) {
      const CellId cell = queue.back();
      queue.pop_back();
      for (const std::uint32_t l : graph_.links_of(cell)) {
        const CellId next = other_end(graph_.links()[l], cell);
        const double x = w_[next.index()];
        if (seen[next.index()] != 0 || is_solid(x)) continue;
        if (is_in_one_[cell.index()] != 0 && !is_negative(x)) continue;
        seen[next.index()] = 1;
        is_in_one_[next.index()] = is_negative(x) ? 1 : 0;
        queue.push_back(next);
      }
    }
  }

  void look_at(const Link& link, CellId cell, Pocket& pocket) {
    const CellId next = other_end(link, cell);
    if (is_in_one_[next.index()] != 0) {
      if (remaining_[next.index()] != 0) pocket.cells.push_back(next);
      remaining_[next.index()] = 0;
      return;
    }
    pocket.area += link.area;
    if (is_solid(w_[next.index()])) return;
    (link.given ? pocket.given : pocket.closing) += link.area;
    if (!link.given) return;
    const std::uint32_t part = part_of_[link.triangle];
    if (solid_area_[part] <= pocket.solid_area) return;
    pocket.part = part;
    pocket.solid_area = solid_area_[part];
  }

  const CellGraph& graph_;
  const PartOf& part_of_;
  const std::vector<double>& solid_area_;
  const std::vector<double>& w_;
  std::vector<char> is_in_one_;  // of each cell
  std::vector<char> remaining_;  // of each cell: in a pocket that was not taken yet
};

bool is_fold(const Pocket& pocket) {
  if (pocket.area >= kSmall * pocket.solid_area) return false;
  const double thickness = 2 * pocket.volume / pocket.area;
  return thickness < kSliver * std::sqrt(pocket.area) ||
         pocket.closing > kMostPatched * pocket.given;
}

// Of each pocket: many folds are no accident, but what the part consists of.
std::vector<char> find_folds(const std::vector<Pocket>& pockets) {
  std::vector<char> is_one;
  std::map<std::uint32_t, double> area;  // of all folds of a part
  for (const Pocket& pocket : pockets) {
    is_one.push_back(is_fold(pocket) ? 1 : 0);
    if (is_one.back() != 0) area[pocket.part] += pocket.area;
  }
  for (std::size_t i = 0; i < pockets.size(); ++i) {
    if (is_one[i] == 0) continue;
    is_one[i] = area[pockets[i].part] < kFew * pockets[i].solid_area ? 1 : 0;
  }
  return is_one;
}

}  // namespace

std::vector<double> solid_areas(const CellGraph& graph, const PartOf& part_of,
                                const std::vector<double>& w) {
  std::vector<double> areas;
  for (const std::uint32_t part : part_of) {
    if (part >= areas.size()) areas.resize(part + 1, 0);
  }
  for (const Link& link : graph.links()) {
    const bool bounds = is_solid(w[link.below.index()]) != is_solid(w[link.above.index()]);
    if (link.given && bounds) areas[part_of[link.triangle]] += link.area;
  }
  return areas;
}

OuterPockets turn_outer_pockets(const CellGraph& graph, const PartOf& part_of,
                                const std::vector<double>& solid_area, std::vector<double>& w) {
  OuterPockets pockets;
  if (std::none_of(w.begin(), w.end(), is_negative)) return pockets;
  pockets.is_left_out.assign(graph.cells(), 0);
  PocketFinder finder(graph, part_of, solid_area, w);
  std::vector<Pocket> found;
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
    if (finder.is_new(c)) found.push_back(finder.take(c));
  }
  const std::vector<char> is_fold = find_folds(found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool left_out = is_fold[i] != 0;
    if (left_out) ++pockets.left_out;
    for (const CellId cell : found[i].cells) {
      w[cell.index()] = left_out ? 0 : -w[cell.index()];
      pockets.is_left_out[cell.index()] = left_out ? 1 : 0;
    }
  }
  return pockets;
}

}  // namespace meshrepair::internal
