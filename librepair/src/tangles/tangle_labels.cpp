#include "tangle_labels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <repair/cell_graph.h>

#include "inside/outer_pockets.h"
#include "tangle_outside.h"
#include "tangle_winding.h"

namespace meshrepair::internal {
namespace {

bool is_negative(double x) { return x < -0.5; }
bool is_solid(double x) { return x > 0.5; }

std::vector<char> undivided_cells(const Tree& tree, const CellComplex& complex) {
  std::vector<char> undivided;
  undivided.reserve(complex.cells.size());
  for (const Cell& cell : complex.cells) {
    undivided.push_back(tree.leaves[cell.leaf].undivided ? 1 : 0);
  }
  return undivided;
}

// The cells that have a facet in common with others that are undivided.
std::vector<char> cells_beside(const CellComplex& complex, const std::vector<char>& undivided) {
  std::vector<char> beside(undivided.size(), 0);
  for (const Facet& f : complex.facets) {
    if (!f.above.valid() || !f.below.valid()) continue;
    if (undivided[f.above.index()] != 0) beside[f.below.index()] = 1;
    if (undivided[f.below.index()] != 0) beside[f.above.index()] = 1;
  }
  return beside;
}

PatchSides sides_of(const std::vector<char>& solid, CellId above, CellId below,
                    std::int32_t winding) {
  const bool is_above = solid[above.index()] != 0, is_below = solid[below.index()] != 0;
  return winding > 0 ? PatchSides{is_above, is_below} : PatchSides{is_below, is_above};
}

class TangleLabeller {
 public:
  TangleLabeller(const Tree& tree, const CoveredCells& covered, const Tangles& tangles,
                 const Orientation& orientation, TangleRays& rays, const InsideOptions& options,
                 InsideReport& report)
      : complex_(covered.complex),
        tangles_(tangles),
        orientation_(orientation),
        options_(options),
        report_(report),
        undivided_(undivided_cells(tree, complex_)),
        beside_(cells_beside(complex_, undivided_)),
        graph_(complex_, covered.cover, options.solve.progress, covered.layers, undivided_),
        rays_(rays) {}

  std::optional<TangleLabels> run() {
    std::optional<TangleWinding> found = find_tangle_winding(
        complex_, graph_, beside_, tangles_, orientation_, rays_, options_.solve.progress);
    if (!found) return std::nullopt;
    winding_ = std::move(*found);
    report_ = {};
    if (options_.rule == InsideRule::automatic && (is_in_doubt() || !turn_pockets())) {
      return std::nullopt;
    }
    TangleLabels labels = label();
    describe(labels);
    return labels;
  }

 private:
  // As turn_parts() has it, which then would look at all cells.
  [[nodiscard]] bool is_in_doubt() const {
    return any_negative() && std::any_of(orientation_.parts.begin(), orientation_.parts.end(),
                                         [](const OrientedPart& p) { return p.outward != 1; });
  }

  [[nodiscard]] bool any_negative() const {
    return std::any_of(winding_.of_cell.begin(), winding_.of_cell.end(), is_negative) ||
           std::any_of(winding_.in_front.begin(), winding_.in_front.end(),
                       [](std::int32_t x) { return x < 0; });
  }

  // Whether all negative cells are known, and what is outside of them.
  bool turn_pockets() {
    std::vector<double>& w = winding_.of_cell;
    if (!any_negative()) return true;
    for (std::size_t c = 0; c < w.size(); ++c) {
      if (is_negative(w[c]) && beside_[c] != 0) return false;
    }
    for (std::uint32_t p = 0; p < tangles_.patches; ++p) {
      if (winding_.in_front[p] < 0 && winding_.patch_has_cells[p] == 0) return false;
    }
    const bool outside_is_known =
        mark_outside(complex_, graph_, beside_, tangles_, winding_, rays_, options_.solve.progress);
    if (!outside_is_known) return false;
    const OuterPockets pockets =
        turn_outer_pockets(graph_, orientation_.part_of, all_solid_areas(), w);
    report_.left_out_folds = pockets.left_out;
    return true;
  }

  // As solid_areas() gives them, of all of the surface.
  [[nodiscard]] std::vector<double> all_solid_areas() const {
    std::vector<double> areas(orientation_.parts.size(), 0);
    const std::vector<double>& w = winding_.of_cell;
    for (const Link& link : graph_.links()) {
      if (!link.given || tangles_.tangled[link.triangle.index()] == 0) continue;
      const bool bounds = is_solid(w[link.below.index()]) != is_solid(w[link.above.index()]);
      if (bounds) areas[orientation_.part_of[link.triangle]] += link.area;
    }
    const CleanSoup& soup = complex_.soup();
    for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
      const std::uint32_t patch = tangles_.patch_of[t.index()];
      if (patch == kNone || soup.triangles[t].source == Triangle::kNoSource) continue;
      if (winding_.in_front[patch] == 0) areas[orientation_.part_of[t]] += grid_area(t.index());
    }
    return areas;
  }

  [[nodiscard]] double grid_area(std::size_t triangle) const {
    const auto& c = tangles_.on_grid.triangles[triangle];
    const auto& p = tangles_.on_grid.points;
    return 0.5 * (p[c[1]] - p[c[0]]).cross(p[c[2]] - p[c[0]]).norm();
  }

  // The sides of a patch that has cells are those of any of these.
  [[nodiscard]] TangleLabels label() const {
    TangleLabels labels;
    for (const double x : winding_.of_cell) labels.solid.push_back(is_solid(x) ? 1 : 0);
    for (const std::int32_t x : winding_.in_front) labels.patches.push_back({x > 0, x + 1 > 0});
    for (const Link& link : graph_.links()) {
      if (!link.opaque() || tangles_.tangled[link.triangle.index()] != 0) continue;
      labels.patches[tangles_.patch_of[link.triangle.index()]] =
          sides_of(labels.solid, link.above, link.below, orientation_.winding[link.triangle]);
    }
    for (std::size_t c = 0; c < undivided_.size(); ++c) {
      labels.states.push_back(undivided_[c] != 0 ? CellState::unknown
                              : beside_[c] != 0  ? CellState::fixed
                                                 : CellState::free);
    }
    labels.links = graph_.links().size();
    return labels;
  }

  void describe(const TangleLabels& labels) {
    report_.asked = options_.rule;
    report_.used = InsideRule::winding;
    report_.exact = true;
    report_.reason = options_.rule == InsideRule::automatic
                         ? "the orientation is consistent everywhere"
                         : "asked for";
    report_.solid_cells =
        static_cast<std::size_t>(std::count(labels.solid.begin(), labels.solid.end(), 1));
  }

  const CellComplex& complex_;
  const Tangles& tangles_;
  const Orientation& orientation_;
  const InsideOptions& options_;
  InsideReport& report_;
  std::vector<char> undivided_, beside_;
  CellGraph graph_;
  TangleRays& rays_;
  TangleWinding winding_;
};

}  // namespace

std::vector<std::uint32_t> find_disagreements(const TangleLabels& labels,
                                              const CoveredCells& covered, const Tangles& tangles,
                                              const Orientation& orientation) {
  const CellComplex& complex = covered.complex;
  const auto stays = [&](CellId c) {
    return !c.valid() || labels.states[c.index()] != CellState::free;
  };
  std::vector<std::uint32_t> found;
  for (FacetId f(0u); f < complex.facets.end_id(); ++f.value) {
    const Facet& facet = complex.facets[f];
    const TriangleId t = covered.cover[f].triangle;
    if (!t.valid() || tangles.tangled[t.index()] != 0) continue;
    if (stays(facet.above) && stays(facet.below)) continue;
    if (labels.patches[tangles.patch_of[t.index()]] !=
        sides_of(labels.solid, facet.above, facet.below, orientation.winding[t])) {
      found.push_back(t.value);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::optional<TangleLabels> label_tangles(const Tree& tree, const CoveredCells& covered,
                                          const Tangles& tangles, const Orientation& orientation,
                                          TangleRays& rays, const InsideOptions& options,
                                          InsideReport& report) {
  return TangleLabeller(tree, covered, tangles, orientation, rays, options, report).run();
}

}  // namespace meshrepair::internal
