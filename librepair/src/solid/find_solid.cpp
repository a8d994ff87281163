// SPDX-License-Identifier: MIT
#include "find_solid.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>
#include <repair/cell_graph.h>
#include <repair/inside_rule.h>
#include <repair/walk.h>

#include "inside/flood.h"
#include "open/open_sheets.h"

namespace meshrepair::internal {
namespace {

SomeParts parts_that_are(bool closed, const CellGraph& graph, const Orientation& orientation) {
  IdVector<TriangleId, char> chosen;
  chosen.reserve(orientation.part_of.size());
  for (const std::uint32_t part : orientation.part_of) {
    chosen.push_back(orientation.parts[part].closed == closed ? 1 : 0);
  }
  SomeParts some{graph.of_triangles(chosen, orientation.winding), orientation};
  for (OrientedPart& part : some.orientation.parts) {
    if (part.closed != closed) part = {};
  }
  return some;
}

bool may_be_a_void(const OrientedPart& part) {
  return part.closed && part.believed && part.outward < 0;
}

}  // namespace

std::optional<ClosedAndOpen> closed_and_open_parts(const CellGraph& graph,
                                                   const Orientation& orientation,
                                                   ProgressObserver* progress) {
  const auto& parts = orientation.parts;
  const auto closed =
      std::count_if(parts.begin(), parts.end(), [](const OrientedPart& p) { return p.closed; });
  if (closed == 0 || static_cast<std::size_t>(closed) == parts.size()) return std::nullopt;
  if (std::any_of(parts.begin(), parts.end(), may_be_a_void)) return std::nullopt;
  if (walk_winding(graph, progress).consistent()) return std::nullopt;
  return ClosedAndOpen{parts_that_are(true, graph, orientation),
                       parts_that_are(false, graph, orientation)};
}

namespace {

// Than made-up surface of all parts together, that of closed parts and open ones apart.
constexpr double kClearlyLess = 0.9;

// Of the boundary of what is solid, what no triangle covers.
double made_up_area(const CellGraph& graph, const std::vector<char>& solid) {
  double sum = 0;
  for (const Link& link : graph.links()) {
    if (!link.opaque() && solid[link.below.index()] != solid[link.above.index()]) sum += link.area;
  }
  return sum;
}

// Only what the triangles seal off by themselves.
void drop_unsealed(const CellGraph& graph, ProgressObserver* progress, CellLabels& labels) {
  const std::vector<char> sealed =
      flood_from_infinity(graph, std::vector<char>(graph.cells(), 1), progress);
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    if (sealed[i] == 0) labels.solid[i] = 0;
  }
}

bool leaves_sheets_open(const RepairOptions& options) {
  if (options.holes.mode == HoleMode::none) return true;
  return options.thicken.wanted() && options.holes.mode != HoleMode::extend;
}

std::string why_nothing_is_solid(const RepairReport& report, HoleMode mode) {
  std::string why = "the triangles enclose nothing: ";
  if (mode == HoleMode::none && report.input.open_edges > 0) {
    return why + "holes are not to be closed, and every part has some";
  }
  if (report.holes.too_large > 0) {
    return why + "open sheets, whose rims are too large for holes (" +
           std::to_string(report.holes.too_large) + ")";
  }
  if (report.open_regions > 0) return why + "what they surround is as open as it is closed";
  return why + "no part of space is inside";
}

// Of the first copy of each triangle; those that close holes are opaque.
IdVector<TriangleId, float> opacities_of(const CleanSoup& soup,
                                         const std::vector<float>& of_input) {
  IdVector<TriangleId, float> opacity;
  opacity.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) {
    opacity.push_back(t.source < of_input.size() ? of_input[t.source] : 1.0f);
  }
  return opacity;
}

struct Decision {
  CellLabels labels;
  InsideReport inside;
  std::size_t open_regions = 0;
};

// What is solid because of open parts is what can be doubted.
void add_solid(const CellLabels& open, CellLabels& labels) {
  for (std::size_t c = 0; c < labels.solid.size(); ++c) {
    if (open.solid[c] == 0) continue;
    if (labels.solid[c] == 0) labels.confidence[c] = open.confidence[c];
    labels.solid[c] = 1;
  }
}

void add_counts(const InsideReport& from, InsideReport& to) {
  to.contradictions += from.contradictions;
  to.turned_parts += from.turned_parts;
  to.doubtful_parts += from.doubtful_parts;
  to.cavity_walls += from.cavity_walls;
  to.poking_walls += from.poking_walls;
  to.poking_share = std::max(to.poking_share, from.poking_share);
  to.left_out_folds += from.left_out_folds;
  to.filled_voids += from.filled_voids;
}

class SolidFinder {
 public:
  SolidFinder(const CleanSoup& soup, const RepairOptions& options)
      : soup_(soup), options_(options), inside_(options.inside) {
    inside_.solve.progress = options.progress;
  }

  Decision run(const CellGraph& graph, const Orientation& orientation) const {
    Decision together = decide(graph, orientation);
    const double made_up = made_up_area(graph, together.labels.solid);
    if (made_up == 0 || inside_.rule != InsideRule::automatic) return together;
    const auto apart = closed_and_open_parts(graph, orientation, options_.progress);
    if (!apart) return together;
    Decision decision = decide(*apart);
    const double less = made_up_area(graph, decision.labels.solid);
    if (less < kClearlyLess * made_up) return decision;
    return together;
  }

 private:
  [[nodiscard]] Decision decide(const CellGraph& graph, const Orientation& orientation) const {
    Decision decision;
    decision.labels = label_cells(graph, orientation, inside_, decision.inside);
    std::vector<char>& solid = decision.labels.solid;
    if (leaves_sheets_open(options_)) drop_unsealed(graph, options_.progress, decision.labels);
    decision.open_regions = empty_open_regions(graph, soup_, solid);
    return decision;
  }

  // The reason is that of the open parts if they enclose anything.
  [[nodiscard]] Decision decide(const ClosedAndOpen& apart) const {
    Decision closed = decide(apart.closed.graph, apart.closed.orientation);
    Decision open = decide(apart.open.graph, apart.open.orientation);
    open.open_regions += closed.open_regions;
    const auto& solid = open.labels.solid;
    const bool any = std::find(solid.begin(), solid.end(), 1) != solid.end();
    add_solid(open.labels, closed.labels);
    open.labels = std::move(closed.labels);
    if (any) {
      add_counts(closed.inside, open.inside);
    } else {
      closed.inside.contradictions += open.inside.contradictions;
      open.inside = std::move(closed.inside);
    }
    open.inside.exact = false;
    return open;
  }

  const CleanSoup& soup_;
  const RepairOptions& options_;
  InsideOptions inside_;
};

}  // namespace

CellLabels find_solid(const CoveredCells& covered, const Orientation& orientation,
                      const RepairOptions& options, RepairReport& report, StageMeter& meter) {
  meter.begin("links");
  CellGraph graph(covered.complex, covered.cover, options.progress, covered.layers);
  if (!options.opacity.empty()) {
    graph.set_opacities(opacities_of(covered.complex.soup(), options.opacity));
  }
  report.links = graph.links().size();
  meter.begin("inside");
  Decision decision = SolidFinder(covered.complex.soup(), options).run(graph, orientation);
  const CellLabels& labels = decision.labels;
  report.inside = std::move(decision.inside);
  report.open_regions = decision.open_regions;
  const double unit = covered.complex.soup().grid.unit;
  report.lost_area = lost_area(graph, labels.solid) * unit * unit;
  report.inside.solid_cells =
      static_cast<std::size_t>(std::count(labels.solid.begin(), labels.solid.end(), 1));
  if (report.inside.solid_cells == 0) {
    throw NoSolidError(why_nothing_is_solid(report, options.holes.mode));
  }
  return std::move(decision.labels);
}

}  // namespace meshrepair::internal
