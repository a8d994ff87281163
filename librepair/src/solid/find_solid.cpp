#include "find_solid.h"

#include <algorithm>
#include <string>
#include <vector>

#include <base/error.h>
#include <repair/cell_graph.h>
#include <repair/flood.h>
#include <repair/inside_rule.h>

#include "closed_and_open.h"
#include "open/open_sheets.h"

namespace meshrepair::internal {
namespace {

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

class SolidFinder {
 public:
  SolidFinder(const CleanSoup& soup, const RepairOptions& options, RepairReport& report)
      : soup_(soup), options_(options), inside_(options.inside), report_(report) {
    inside_.solve.progress = options.progress;
  }

  CellLabels run(const CellGraph& graph, const Orientation& orientation) {
    const auto apart = inside_.rule == InsideRule::automatic
                           ? closed_and_open_parts(graph, orientation, options_.progress)
                           : std::nullopt;
    if (!apart) return labels_of(graph, orientation, report_.inside);
    CellLabels labels = labels_of(apart->closed.graph, apart->closed.orientation, report_.inside);
    InsideReport of_open;
    add(labels_of(apart->open.graph, apart->open.orientation, of_open), of_open, labels);
    report_.inside.exact = false;
    return labels;
  }

 private:
  CellLabels labels_of(const CellGraph& graph, const Orientation& orientation,
                       InsideReport& report) {
    CellLabels labels = label_cells(graph, orientation, inside_, report);
    if (leaves_sheets_open(options_)) drop_unsealed(graph, options_.progress, labels);
    report_.open_regions += empty_open_regions(graph, soup_, labels.solid);
    return labels;
  }

  // What is solid because of open parts is what can be doubted.
  void add(const CellLabels& open, const InsideReport& of_open, CellLabels& labels) {
    bool any = false;
    for (std::size_t c = 0; c < labels.solid.size(); ++c) {
      if (open.solid[c] == 0) continue;
      any = true;
      if (labels.solid[c] == 0) labels.confidence[c] = open.confidence[c];
      labels.solid[c] = 1;
    }
    InsideReport& inside = report_.inside;
    inside.contradictions += of_open.contradictions;
    if (!any) return;
    inside.used = of_open.used;
    inside.reason = of_open.reason;
    inside.other = of_open.other;
    inside.solve = of_open.solve;
    inside.winding_distance = of_open.winding_distance;
    inside.winding_contradiction = of_open.winding_contradiction;
    inside.loose_share = of_open.loose_share;
    inside.turned_parts += of_open.turned_parts;
    inside.doubtful_parts += of_open.doubtful_parts;
    inside.cavity_walls += of_open.cavity_walls;
    inside.poking_walls += of_open.poking_walls;
    inside.poking_share = std::max(inside.poking_share, of_open.poking_share);
    inside.left_out_folds += of_open.left_out_folds;
  }

  const CleanSoup& soup_;
  const RepairOptions& options_;
  InsideOptions inside_;
  RepairReport& report_;
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
  report.open_regions = 0;
  CellLabels labels = SolidFinder(covered.complex.soup(), options, report).run(graph, orientation);
  const double unit = covered.complex.soup().grid.unit;
  report.lost_area = lost_area(graph, labels.solid) * unit * unit;
  report.inside.solid_cells =
      static_cast<std::size_t>(std::count(labels.solid.begin(), labels.solid.end(), 1));
  if (report.inside.solid_cells == 0) {
    throw NoSolidError(why_nothing_is_solid(report, options.holes.mode));
  }
  return labels;
}

}  // namespace meshrepair::internal
