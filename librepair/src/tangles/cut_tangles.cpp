// Idea: most triangles of most meshes meet no other one. Space is divided only around the tangled
// ones: a region that none of these touches is left as a leaf, whatever passes through it. So all
// facets around a tangled triangle, and around its edges, lie between cells that are divided to the
// end, and what is left of it is what all cells would leave.
#include "cut_tangles.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <bsp/build_tree.h>
#include <check/box_tree.h>
#include <extract/extract_surface.h>

#include "cells/covered_cells.h"
#include "sew_pieces.h"
#include "sheets/fill_slits.h"
#include "tangle_labels.h"
#include "tangles.h"
#include "valid/keep_valid.h"

namespace meshrepair::internal {
namespace {

// With a larger share of its triangles tangled, dividing all of the soup takes no longer.
constexpr double kMostTangled = 0.2;

// In fragments at nodes for each triangle, of which all of a soup has about two: with more,
// neither.
constexpr double kMostDivided = 1.5;

// Regions with more fragments than this are cut across an axis: smaller ones than where all is
// divided, as most of what is cut off is left undivided.
constexpr std::size_t kSmallRegion = 24;

// Each attempt but the last may find that more triangles are tangled.
constexpr std::size_t kMostAttempts = 3;

// Of the surface, the share that may go with slits and fins in single precision: with more, a
// format is too coarse for the mesh, and where slits end depends on cells farther away.
constexpr double kMostFilled = 0.01;

bool is_wanted(const Orientation& orientation, const RepairOptions& options) {
  if (!may_spare_cells(options) || may_fill(options.inside)) return false;
  if (options.inside.rule == InsideRule::winding) return true;
  // Of parts that may face either way all cells have to tell.
  return options.inside.rule == InsideRule::automatic &&
         std::all_of(orientation.parts.begin(), orientation.parts.end(),
                     [](const OrientedPart& p) { return p.believed; });
}

std::vector<Box> boxes_of_tangles(const Tangles& tangles) {
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < tangles.tangled.size(); ++t) {
    if (tangles.tangled[t] == 0) continue;
    Box& box = boxes.emplace_back();
    for (const std::uint32_t p : tangles.on_grid.triangles[t]) box.add(tangles.on_grid.points[p]);
  }
  return boxes;
}

Tree divide_around(const CleanSoup& soup, const Tangles& tangles, const RepairOptions& options,
                   BuildTreeReport& report) {
  const std::vector<Box> boxes = boxes_of_tangles(tangles);
  const BoxTree near(boxes);
  BuildTreeOptions tree_options = options.tree;
  tree_options.progress = options.progress;
  tree_options.spatial_cut_above = std::min(tree_options.spatial_cut_above, kSmallRegion);
  tree_options.divides = [&](const Vec3d& low, const Vec3d& high) {
    Box region;
    region.add(low);
    region.add(high);
    bool touched = false;
    near.visit([&](const Box& box) { return !touched && box.meets(region); },
               [&](std::uint32_t i) { touched = touched || boxes[i].meets(region); });
    return touched;
  };
  return build_tree(soup, tree_options, report);
}

std::vector<std::uint8_t> places_of(const CoveredCells& covered, const Tangles& tangles,
                                    const TangleLabels& labels) {
  std::vector<std::uint8_t> places =
      places_of_triangles(covered.complex, covered.cover, labels.solid);
  for (std::size_t t = 0; t < places.size(); ++t) {
    if (tangles.tangled[t] != 0) continue;
    const PatchSides& sides = labels.patches[tangles.patch_of[t]];
    places[t] = place_between(sides.solid_in_front, sides.solid_behind);
  }
  return places;
}

class TangleCutter {
 public:
  TangleCutter(const CleanSoup& soup, const Orientation& orientation, Tangles tangles,
               const RepairOptions& options, RepairReport& report, StageMeter& meter)
      : soup_(soup),
        orientation_(orientation),
        tangles_(std::move(tangles)),
        rays_(tangles_),
        options_(options),
        report_(report),
        meter_(meter) {}

  std::optional<Surface> run() {
    for (std::size_t attempt = 0; attempt < kMostAttempts && !are_too_many(); ++attempt) {
      meter_.begin("tree");
      Tree tree = divide_around(soup_, tangles_, options_, report_.tree);
      if (is_divided_too_far(tree)) return std::nullopt;
      const CoveredCells covered =
          make_cells(tree, orientation_.winding, options_, report_, meter_);
      std::optional<TangleLabels> labels = label(tree, covered);
      if (!labels) return std::nullopt;
      // Where a slit is filled, a triangle may go in part that nothing else meets.
      const std::vector<std::uint32_t> more =
          find_disagreements(*labels, covered, tangles_, orientation_);
      if (more.empty()) return extract(tree, covered, *labels);
      add_tangled(more, tangles_);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool are_too_many() const {
    return static_cast<double>(tangles_.count) >
           kMostTangled * static_cast<double>(tangles_.tangled.size());
  }

  [[nodiscard]] bool is_divided_too_far(const Tree& tree) const {
    return static_cast<double>(tree.node_triangles.size()) >
           kMostDivided * static_cast<double>(tangles_.tangled.size());
  }

  std::optional<TangleLabels> label(const Tree& tree, const CoveredCells& covered) {
    meter_.begin("inside");
    InsideOptions inside = options_.inside;
    inside.solve.progress = options_.progress;
    std::optional<TangleLabels> labels =
        label_tangles(tree, covered, tangles_, orientation_, rays_, inside, report_.inside);
    if (!labels) return std::nullopt;
    const bool is_single = options_.certify.precision == Precision::float32;
    // Where sheets must not be so near to each other, others are divided as well.
    const std::vector<char> stays = is_single ? std::vector<char>{} : untangled();
    fill_slits(covered, options_, labels->states, stays, labels->solid, report_);
    const double filled = report_.slits_area + report_.fins_area;
    const bool is_minor = !is_single || filled <= kMostFilled * report_.input_area;
    if (!is_minor || report_.thin_cells.reaches_fixed) return std::nullopt;
    return labels;
  }

  // Of each triangle, whether it is.
  [[nodiscard]] std::vector<char> untangled() const {
    std::vector<char> whole(tangles_.tangled.size());
    std::transform(tangles_.tangled.begin(), tangles_.tangled.end(), whole.begin(),
                   [](char tangled) { return tangled == 0 ? 1 : 0; });
    return whole;
  }

  std::optional<Surface> extract(Tree& tree, const CoveredCells& covered,
                                 const TangleLabels& labels) {
    meter_.begin("extract");
    report_.parts = find_part_fates(soup_, places_of(covered, tangles_, labels));
    const Surface pieces = extract_pieces(tree, covered, labels);
    std::optional<Surface> sewn = sew_pieces(soup_, tangles_, labels.patches, pieces);
    if (!sewn || sewn->mesh.triangles.empty()) return std::nullopt;
    report_.links = labels.links;
    report_.set_aside = tangles_.tangled.size() - tangles_.count;
    return sewn;
  }

  // By the numbers of the triangles as sources, without the sides of what is left undivided.
  Surface extract_pieces(Tree& tree, const CoveredCells& covered, const TangleLabels& labels) {
    for (TriangleId t(0u); t < tree.input.triangles.end_id(); ++t.value) {
      tree.input.triangles[t].source = t.value;
    }
    const std::vector<char> whole = untangled();
    ExtractOptions extract_options = options_.extract;
    extract_options.whole = whole;
    extract_options.tell_facets = true;
    extract_options.progress = options_.progress;
    Surface pieces = extract_surface(covered.complex, covered.cover, labels.solid, report_.extract,
                                     extract_options);
    const auto is_undivided = [&](CellId c) {
      return tree.leaves[covered.complex.cells[c].leaf].undivided;
    };
    std::vector<char> keep;
    for (const FacetId f : report_.extract.facet_of) {
      const Facet& facet = covered.complex.facets[f];
      const bool is_end = is_undivided(facet.above) || is_undivided(facet.below);
      keep.push_back(is_end && !covered.cover[f].opaque() ? 0 : 1);
    }
    report_.extract.facet_of = {};
    keep_triangles(pieces, keep);
    return pieces;
  }

  const CleanSoup& soup_;
  const Orientation& orientation_;
  Tangles tangles_;
  TangleRays rays_;
  const RepairOptions& options_;
  RepairReport& report_;
  StageMeter& meter_;
};

}  // namespace

std::optional<Surface> cut_tangles(const CleanSoup& soup, const Orientation& orientation,
                                   const RepairOptions& options, RepairReport& report,
                                   StageMeter& meter) {
  if (!is_wanted(orientation, options)) return std::nullopt;
  meter.begin("tangles");
  std::optional<Tangles> tangles = find_tangles(soup, orientation.winding, options.progress);
  if (!tangles) return std::nullopt;
  return TangleCutter(soup, orientation, std::move(*tangles), options, report, meter).run();
}

}  // namespace meshrepair::internal
