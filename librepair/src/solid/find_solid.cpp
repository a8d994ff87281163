#include "find_solid.h"

#include <algorithm>
#include <string>
#include <vector>

#include <base/error.h>
#include <repair/cell_graph.h>
#include <repair/flood.h>

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
  InsideOptions inside_options = options.inside;
  inside_options.solve.progress = options.progress;
  CellLabels labels = label_cells(graph, orientation, inside_options, report.inside);
  if (leaves_sheets_open(options)) {
    drop_unsealed(graph, options.progress, labels);
  }
  report.open_regions = empty_open_regions(covered, labels.solid);
  report.inside.solid_cells =
      static_cast<std::size_t>(std::count(labels.solid.begin(), labels.solid.end(), 1));
  if (report.inside.solid_cells == 0) {
    throw NoSolidError(why_nothing_is_solid(report, options.holes.mode));
  }
  return labels;
}

}  // namespace meshrepair::internal
