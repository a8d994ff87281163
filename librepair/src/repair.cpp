#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <base/error.h>
#include <repair/cell_graph.h>
#include <repair/flood.h>
#include <repair/repair.h>

#include "cells/covered_cells.h"
#include "finish/make_surface.h"
#include "open/open_sheets.h"
#include "tangles/cut_tangles.h"
#include "valid/keep_valid.h"

namespace meshrepair {
namespace {

using internal::CoveredCells;
using internal::empty_open_regions;
using internal::is_flat_sheet;
using internal::make_cells;

// The parts of the input: oriented for `automatic`, else as they are connected through edges, which
// does not depend on how their triangles are turned.
Orientation find_parts(const CleanSoup& soup, const RepairOptions& options, RepairReport& report) {
  if (options.inside.rule == InsideRule::automatic) {
    return orient_parts(soup, report.orient, options.progress);
  }
  TopologyPlaces places;
  report.orient.parts = examine_topology(index_triangles(soup), soup.points.size(), &places).parts;
  Orientation as_given;
  as_given.winding = windings_of(soup);
  for (const std::uint32_t part : places.parts) as_given.part_of.push_back(part);
  return as_given;
}

// Known before any work, and worth asking: overlaps in one plane fall into very many pieces.
void require_space(const CleanSoup& soup) {
  if (soup.triangles.empty()) return;
  const PlaneId first = soup.triangles[TriangleId(0u)].plane;
  if (std::all_of(soup.triangles.begin(), soup.triangles.end(),
                  [&](const Triangle& t) { return t.plane == first; })) {
    throw NoSolidError("all triangles lie in one plane, so they enclose nothing");
  }
  if (is_flat_sheet(soup)) {
    throw NoSolidError(
        "all triangles lie in one plane, but for the rounding of their coordinates, and leave "
        "edges open, so they enclose nothing");
  }
}

// Only what the triangles seal off by themselves.
void drop_unsealed(const CellGraph& graph, ProgressObserver* progress, CellLabels& labels) {
  const std::vector<char> sealed =
      flood_from_infinity(graph, std::vector<char>(graph.cells(), 1), progress);
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    if (sealed[i] == 0) labels.solid[i] = 0;
  }
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
  if (options.holes.mode == HoleMode::none) {
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

// Cleaned, its holes closed.
CleanSoup close_soup(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report,
                     StageMeter& meter) {
  meter.begin("clean");
  CleanSoup clean = clean_soup(soup, report.clean, options.progress);
  report.input = examine_topology(index_triangles(clean), clean.points.size());
  report.input_area = 0;
  for (const Triangle& t : clean.triangles) report.input_area += area_of(clean, t);
  report.holes = {};
  if (clean.triangles.empty()) {
    throw NoSolidError(
        "no triangle is left: all are degenerate, or smaller than the working grid of 2^26 steps "
        "over "
        "their bounding box, or have coordinates that are not finite");
  }
  if (report.input.open_edges > 0 || report.input.nonmanifold_edges > 0) {
    meter.begin("holes");
    patch_holes(clean, options.holes, report.holes, options.progress);
  }
  return clean;
}

Tree make_tree(CleanSoup clean, const RepairOptions& options, RepairReport& report,
               StageMeter& meter) {
  meter.begin("tree");
  BuildTreeOptions tree_options = options.tree;
  tree_options.progress = options.progress;
  return build_tree(std::move(clean), tree_options, report.tree);
}

std::vector<char> solid_cells(const Tree& tree, const CellComplex& complex) {
  std::vector<char> solid;
  solid.reserve(complex.cells.size());
  for (const Cell& cell : complex.cells) {
    solid.push_back(tree.leaves[cell.leaf].label == Label::solid ? 1 : 0);
  }
  return solid;
}

void require_labels(const Tree& tree) {
  bool any_solid = false;
  for (const Leaf& leaf : tree.leaves) {
    if (leaf.label == Label::unknown) {
      throw InputError("the tree is not labelled: run bspsolid on it first");
    }
    any_solid |= leaf.label == Label::solid;
  }
  if (!any_solid) throw NoSolidError("no leaf of the tree is solid");
}

}  // namespace

Tree make_tree(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  return make_tree(close_soup(soup, options, report, meter), options, report, meter);
}

void label_tree(Tree& tree, const RepairOptions& options, RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  require_space(tree.input);
  meter.begin("orient");
  const Orientation orientation = find_parts(tree.input, options, report);
  const CoveredCells covered = make_cells(tree, orientation.winding, options, report, meter);
  const CellLabels labels = find_solid(covered, orientation, options, report, meter);
  for (CellId c(0u); c < covered.complex.cells.end_id(); ++c.value) {
    tree.leaves[covered.complex.cells[c].leaf] = {
        labels.solid[c.index()] != 0 ? Label::solid : Label::empty, labels.confidence[c.index()]};
  }
}

Surface extract_mesh(const Tree& tree, const RepairOptions& options, RepairReport& report) {
  require_labels(tree);
  StageMeter meter(report.stages, options.progress);
  CoveredCells covered = make_cells(tree, windings_of(tree.input), options, report, meter);
  const std::vector<char> solid = solid_cells(tree, covered.complex);
  return internal::make_surface(std::move(covered), solid, options, report, meter);
}

Surface repair(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  std::optional<Invalid> invalid;
  if (auto kept = internal::keep_as_given(soup, options, report, meter, invalid)) {
    return std::move(*kept);
  }
  CleanSoup clean = close_soup(soup, options, report, meter);
  require_space(clean);
  meter.begin("orient");
  const Orientation orientation = find_parts(clean, options, report);
  if (auto mended = internal::keep_mended(clean, orientation, invalid, options, report, meter)) {
    return std::move(*mended);
  }
  if (auto cut = internal::cut_tangles(clean, orientation, options, report, meter)) {
    return std::move(*cut);
  }
  Tree tree = make_tree(std::move(clean), options, report, meter);
  CoveredCells covered = make_cells(tree, orientation.winding, options, report, meter);
  // From here on only the input is needed, not the partition.
  tree.nodes = {};
  tree.node_triangles = {};
  tree.leaves = {};
  const CellLabels labels = find_solid(covered, orientation, options, report, meter);
  return internal::make_surface(std::move(covered), labels.solid, options, report, meter);
}

RepairResult repair(const TriangleSoup& soup, const RepairOptions& options) {
  RepairResult result;
  result.surface = repair(soup, options, result.report);
  return result;
}

}  // namespace meshrepair
