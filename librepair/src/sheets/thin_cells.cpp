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
#include <optional>
#include <queue>
#include <utility>

#include <Eigen/Core>

#include <repair/thin_cells.h>

#include "cell_widths.h"
#include "minimum_cut.h"

namespace meshrepair {
namespace {

using internal::CellWidth;
using internal::CellWidths;
using internal::CutEdge;
using internal::CutNode;

// Of its normal and the direction across the cell, the least product of a side that is broad.
constexpr double kBroad = 0.5;

// How much farther than the width of a cell the boundary may move, over several of them.
constexpr double kReach = 2;

// What a cell costs that changes, of the area of its broad sides: what gains less is no sheet that
// comes near to another one, but the same one on the other side of the cell.
constexpr double kCostOfChange = 0.05;

// Of the volume: if more would go with what becomes empty, that is no fin but what there is.
constexpr double kMostFins = 0.1;

// In grid units, what only open parts surround and is not wider counts for nothing: a sheet may be
// as thick when its points are put on the grid.
constexpr double kSheet = 2;

// The last round leaves out what is still wanted and must not be.
constexpr int kMostRounds = 8;

// All costs add up to less than 2^60.
constexpr int kBitsOfCosts = 60;

constexpr double kFar = std::numeric_limits<double>::infinity();

Vec3d vector_of(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

class ThinCells {
 public:
  ThinCells(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
            const ThinCellsOptions& options, std::vector<char>& solid)
      : complex_(complex),
        cover_(cover),
        options_(options),
        solid_(solid),
        cancel_(options.progress),
        node_of_(solid.size(), kUnseen),
        cut_(options.open.begin(), options.open.end()) {
    cut_.resize(complex.soup().triangles.size(), 0);
  }

  // Nothing changed if the report says so.
  ThinCellsReport run() {
    find_cut_triangles();
    find_thin_cells();
    if (nodes_.empty()) return {};
    find_what_stays();
    find_costs();
    for (int round = 1; find_wanted(); ++round) {
      find_reached();
      const bool is_stable = make_stay();
      if (!is_stable && round < kMostRounds) continue;
      if (!is_stable) leave_out_unreached();
      change_reached();
      break;
    }
    return emptied_volume_ <= kMostFins * known_volume() ? report_ : ThinCellsReport{};
  }

 private:
  static constexpr std::uint32_t kUnseen = kNone, kWide = kNone - 1;

  // A thin cell.
  struct Node {
    CellId cell;
    CellWidth width;
    bool stays = false;
    bool wanted = false;  // to change
    double moved = kFar;  // how far the boundary moves if the cell changes; far: it must not
  };

  struct Costs {
    double solid = 0, empty = 0;  // of what lies beside cells that are no nodes
  };

  // What lies between two nodes.
  struct Between {
    std::uint32_t node, other;
    double area;
  };

  // A facet of the cell that is looked at.
  struct Side {
    FacetId facet;
    CellId other;   // invalid: outside the box
    double facing;  // of its outward normal and the direction across the cell, the product
  };

  [[nodiscard]] bool is_solid(CellId cell) const {
    return cell.valid() && solid_[cell.index()] != 0;
  }
  [[nodiscard]] CellState state_of(CellId cell) const {
    return cell.valid() && !options_.states.empty() ? options_.states[cell.index()]
                                                    : CellState::free;
  }
  [[nodiscard]] bool is_unknown(CellId cell) const { return state_of(cell) == CellState::unknown; }

  [[nodiscard]] bool is_boundary(FacetId f) const {
    const Facet& facet = complex_.facets[f];
    return !is_unknown(facet.above) && !is_unknown(facet.below) &&
           is_solid(facet.above) != is_solid(facet.below);
  }
  [[nodiscard]] bool is_cut(FacetId f) const {
    return !cover_[f].opaque() || cut_[cover_[f].triangle.index()] != 0;
  }

  void find_cut_triangles() {
    for (FacetId f(0u); f < complex_.facets.end_id(); ++f.value) {
      if (!cover_[f].opaque() || is_boundary(f)) continue;
      const Facet& facet = complex_.facets[f];
      if (is_unknown(facet.above) || is_unknown(facet.below)) continue;
      cut_[cover_[f].triangle.index()] = 1;
    }
  }

  // Those beside boundary that is cut, and from there on through thin ones: others, which are most
  // of a complex, would not change.
  void find_thin_cells() {
    CellWidths widths(complex_, options_.within);
    const auto visit = [&](CellId cell) {
      cancel_.tick();
      if (!cell.valid() || node_of_[cell.index()] != kUnseen || is_unknown(cell)) return;
      const std::optional<CellWidth> width = widths.measure(cell);
      node_of_[cell.index()] = width ? static_cast<std::uint32_t>(nodes_.size()) : kWide;
      if (width) nodes_.push_back({cell, *width});
    };
    for (FacetId f(0u); f < complex_.facets.end_id(); ++f.value) {
      if (!is_boundary(f) || !is_cut(f)) continue;
      visit(complex_.facets[f].above);
      visit(complex_.facets[f].below);
    }
    for (std::size_t next = 0; next < nodes_.size(); ++next) {
      const CellId cell = nodes_[next].cell;
      complex_.for_each_facet(cell, [&](FacetId f) { visit(across(f, cell)); });
    }
  }

  [[nodiscard]] CellId across(FacetId f, CellId cell) const {
    const Facet& facet = complex_.facets[f];
    return facet.below == cell ? facet.above : facet.below;
  }

  // Beside an edge of a triangle that stays, new boundary would divide the edge.
  void find_what_stays() {
    if (options_.stays.empty()) return;
    std::vector<char> edge_stays(complex_.edges.size(), 0);
    for (FacetId f(0u); f < complex_.facets.end_id(); ++f.value) {
      if (!cover_[f].opaque() || options_.stays[cover_[f].triangle.index()] == 0) continue;
      complex_.for_each_use(f,
                            [&](UseId use) { edge_stays[complex_.uses[use].edge().index()] = 1; });
    }
    for (Node& node : nodes_) {
      complex_.for_each_facet(node.cell, [&](FacetId f) {
        complex_.for_each_use(f, [&](UseId use) {
          if (edge_stays[complex_.uses[use].edge().index()] != 0) node.stays = true;
        });
      });
    }
  }

  // Areas, and then the costs that they are in the cut.
  void find_costs() {
    double total = 0;
    std::vector<Costs> beside(nodes_.size());
    std::vector<Between> between;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      cancel_.tick();
      const Node& node = nodes_[n];
      double broad = 0;
      for (const Side& side : sides_of(node)) {
        const double area = facet_area(complex_, side.facet);
        if (std::abs(side.facing) >= kBroad) broad += area;
        total += area;
        const std::uint32_t other = node_of(side.other);
        if (other < kWide) {
          if (other > n) between.push_back({n, other, area});
        } else {
          (is_solid_beside(side.other, node.cell) ? beside[n].empty : beside[n].solid) += area;
        }
      }
      (is_solid(node.cell) ? beside[n].empty : beside[n].solid) += kCostOfChange * broad;
      total += kCostOfChange * broad;
    }
    const double scale = std::ldexp(1.0, kBitsOfCosts - exponent_of(total));
    scale_costs(beside, between, scale);
  }

  // What is boundary is rounded down, and the rest up: nothing changes for the sake of rounding,
  // which is about a grid unit squared where broad sheets are among the sides.
  void scale_costs(const std::vector<Costs>& beside, const std::vector<Between>& between,
                   double scale) {
    const auto cost = [&](double area, bool of_boundary) {
      return static_cast<std::int64_t>(of_boundary ? std::floor(area * scale)
                                                   : std::ceil(area * scale));
    };
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const bool solid = is_solid(nodes_[n].cell);
      costs_.push_back({cost(beside[n].solid, solid), cost(beside[n].empty, !solid)});
    }
    for (const Between& b : between) {
      const bool of_boundary = is_solid(nodes_[b.node].cell) != is_solid(nodes_[b.other].cell);
      edges_.push_back({b.node, b.other, cost(b.area, of_boundary)});
    }
  }

  // Of a power of two above x.
  static int exponent_of(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return exponent + 1;
  }

  [[nodiscard]] std::uint32_t node_of(CellId cell) const {
    return cell.valid() ? node_of_[cell.index()] : kWide;
  }

  // What is unknown is taken for the same as the cell beside it.
  [[nodiscard]] bool is_solid_beside(CellId other, CellId cell) const {
    return is_solid(is_unknown(other) ? cell : other);
  }

  [[nodiscard]] const std::vector<Side>& sides_of(const Node& node) {
    sides_.clear();
    const Vec3d across_cell = vector_of(complex_.planes[node.width.across].unit);
    complex_.for_each_facet(node.cell, [&](FacetId f) {
      const Facet& facet = complex_.facets[f];
      const double facing = vector_of(complex_.planes[facet.plane].unit).dot(across_cell);
      sides_.push_back({f, across(f, node.cell), facet.below == node.cell ? facing : -facing});
    });
    return sides_;
  }

  // What changes with the minimum cut; false: nothing.
  bool find_wanted() {
    std::vector<CutNode> costs = costs_;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (!nodes_[n].stays) continue;
      (is_solid(nodes_[n].cell) ? costs[n].out : costs[n].in) = internal::kForbidden;
    }
    const std::vector<char> solid = internal::minimum_cut(costs, edges_);
    bool is_any = false;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      nodes_[n].wanted = (solid[n] != 0) != is_solid(nodes_[n].cell);
      nodes_[n].moved = kFar;
      is_any = is_any || nodes_[n].wanted;
    }
    return is_any;
  }

  // The nearest to the boundary first.
  void find_reached() {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto enqueue = [&](std::uint32_t n) {
      if (!nodes_[n].wanted || nodes_[n].moved < kFar) return;
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
      if (nodes_[n].moved < kFar) continue;
      nodes_[n].moved = distance;
      reached_.push_back(n);
      complex_.for_each_facet(nodes_[n].cell, [&](FacetId f) {
        const std::uint32_t other = node_of(across(f, nodes_[n].cell));
        if (other < kWide) enqueue(other);
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
    for (const Side& side : sides_of(node)) {
      const bool bounds = is_boundary(side.facet);
      const std::uint32_t other = node_of(side.other);
      const double moved_there = other < kWide ? nodes_[other].moved : kFar;
      may_go = may_go || (bounds && is_cut(side.facet)) || moved_there < kFar;
      if (std::abs(side.facing) < kBroad) continue;
      const std::size_t which = side.facing > 0 ? 0 : 1;
      is_there[which] = true;
      moved[which] = std::max(moved[which], bounds ? 0 : moved_there);
    }
    double best = kFar;
    for (const std::size_t which : {std::size_t{0}, std::size_t{1}}) {
      if (may_go && is_there[which]) best = std::min(best, moved[which] + node.width.width);
    }
    return best;
  }

  // Whatever is wanted and must not be; true: nothing is.
  bool make_stay() {
    bool is_stable = true;
    for (Node& node : nodes_) {
      if (!node.wanted) continue;
      const bool is_fixed = state_of(node.cell) != CellState::free;
      if (node.moved < kFar && !is_fixed) continue;
      report_.reaches_fixed = report_.reaches_fixed || (node.moved < kFar && is_fixed);
      node.stays = true;
      is_stable = false;
    }
    return is_stable;
  }

  // With all that is connected with it through cells that are wanted.
  void leave_out_unreached() {
    std::vector<std::uint32_t> queue;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      if (nodes_[n].wanted && nodes_[n].stays) queue.push_back(n);
    }
    for (const std::uint32_t n : queue) nodes_[n].wanted = false;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const CellId cell = nodes_[queue[next]].cell;
      complex_.for_each_facet(cell, [&](FacetId f) {
        const std::uint32_t other = node_of(across(f, cell));
        if (other >= kWide || !nodes_[other].wanted) return;
        nodes_[other].wanted = false;
        queue.push_back(other);
      });
    }
    std::erase_if(reached_, [&](std::uint32_t n) { return !nodes_[n].wanted; });
  }

  void change_reached() {
    for (const std::uint32_t n : reached_) {
      const CellId cell = nodes_[n].cell;
      double gain = 0;
      complex_.for_each_facet(cell, [&](FacetId f) {
        const double area = facet_area(complex_, f);
        gain += is_boundary(f) ? area : -area;
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
  [[nodiscard]] double known_volume() const {
    double volume = emptied_volume_;
    if (emptied_volume_ == 0) return volume;
    std::vector<char> changed(solid_.size(), 0);
    for (const std::uint32_t n : reached_) changed[nodes_[n].cell.index()] = 1;
    for (CellId c(0u); c < complex_.cells.end_id(); ++c.value) {
      const bool was_solid = is_solid(c) && changed[c.index()] == 0;
      if (was_solid && !is_unknown(c)) volume += cell_volume(complex_, c);
    }
    return volume;
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  const ThinCellsOptions& options_;
  std::vector<char>& solid_;
  CancelCheck cancel_;
  std::vector<std::uint32_t> node_of_;  // of each cell
  std::vector<char> cut_;  // of each triangle, whether a piece of it is no boundary, or may be
  std::vector<Node> nodes_;
  std::vector<CutNode> costs_;
  std::vector<CutEdge> edges_;
  std::vector<std::uint32_t> reached_;  // of what is wanted, in the order in which it changes
  std::vector<Side> sides_;
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
