// SPDX-License-Identifier: MIT
// The whole way, and the table of its contents.
//
// A soup becomes a solid by the first of five ways that applies. They are tried from the cheapest
// to the one that always does; where two apply they give the same solid, but for the last bits of
// new points. Each is a function of one shape: a surface, or nothing and the next way.
//
// - As given, when the soup is the boundary of a solid: promises the soup itself, bit for bit.
// - In few places, when it is large and one but for these: promises all other triangles, bit for
//   bit, and the places as a repair of them alone makes them.
// - Mended, when it is one once copies are dropped, holes closed and parts turned: promises its
//   triangles, with their own coordinates, and patches.
// - By chambers, when hardly any triangle is in a loose sheet or contradicts the others:
//   triangles are cut in their own planes, and space is not divided. Promises what all cells
//   would give, certified.
// - Cells everywhere, always: promises a surface as near to a certified one as could be had.
//
// The last one makes cells (cells/). The last two say what is solid (arrange/, solid/), by the
// rules of inside/. In surface/ the boundary is extracted, simplified and certified: attempt by
// attempt (make_surface.cpp), each with rounds of repairing it again on coarser grids
// (certify_surface.cpp). Last of all, solids that are not wanted go, and triangles where fewer are
// wanted (fewer/).
//
// Voids are filled in two ways: where it is asked what is solid, they are; where it is not, they
// are parts of the surface, whose walls go last of all, and what stays is as it was given.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <base/error.h>
#include <repair/explain_repair.h>
#include <repair/join_gaps.h>
#include <repair/keep_parts.h>
#include <repair/repair.h>
#include <repair/valid_solid.h>

#include "arrange/chamber_surface.h"
#include "cells/covered_cells.h"
#include "fewer/fewer_triangles.h"
#include "prepare/prepare.h"
#include "report/describe_result.h"
#include "resume/saved_states.h"
#include "seal/seal_solid.h"
#include "solid/find_solid.h"
#include "surface/make_surface.h"
#include "thicken/unite_walls.h"
#include "valid/keep_valid.h"

namespace meshrepair {
namespace {

// What the ways work on.
struct Job {
  const TriangleSoup& soup;
  const RepairOptions& options;
  RepairReport& report;
  StageMeter meter;
  internal::SavedStates states = internal::SavedStates(soup, options);
  std::optional<Invalid> invalid = {};  // what the first way found of the soup
  internal::NearlySolid nearly = {};    // where triangles meet
  bool prepared = false;
  CleanSoup clean = {};  // once prepared: on the grid, its holes closed
  Orientation orientation = {};

  void prepare() {
    if (std::exchange(prepared, true)) return;
    clean = internal::close_soup(soup, options, report, meter);
    orientation = internal::orient_soup(clean, options, report, meter);
    meter.end();
    states.save(internal::kPreparedState, clean, orientation, invalid, report);
  }

  // The surface of an earlier run that got so far; else that run may have prepared the soup.
  std::optional<Surface> resumed() {
    const bool is_repaired = states.has(internal::kRepairedState);
    if (!is_repaired && !states.has(internal::kPreparedState)) return std::nullopt;
    meter.begin("resume");
    Surface surface;
    RepairReport saved;
    if (is_repaired && states.load(internal::kRepairedState, surface, saved)) {
      go_on_from(std::move(saved));
      return surface;
    }
    prepared = states.load(internal::kPreparedState, clean, orientation, invalid, saved);
    if (prepared) go_on_from(std::move(saved));
    return std::nullopt;
  }

  void keep_repaired(const Surface& surface) {
    if (!prepared) return;
    states.save(internal::kRepairedState, surface, report);
    states.drop(internal::kPreparedState);
    states.drop(internal::kChambersState);
  }

 private:
  // Stages of this run follow those of the other one.
  void go_on_from(RepairReport saved) {
    meter.end();
    saved.stages.insert(saved.stages.end(), report.stages.begin(), report.stages.end());
    report = std::move(saved);
  }
};

std::optional<Surface> as_given(Job& job) {
  if (job.prepared) return std::nullopt;
  return internal::keep_as_given(job.soup, job.options, job.report, job.meter, job.invalid,
                                 job.nearly);
}

std::optional<Surface> mended(Job& job) {
  job.prepare();
  if (job.states.has(internal::kChambersState)) return std::nullopt;
  return internal::keep_mended(job.clean, job.orientation, job.invalid, job.options, job.report,
                               job.meter);
}

std::optional<Surface> by_chambers(Job& job) {
  if (!internal::may_spare_cells(job.options)) return std::nullopt;
  job.prepare();
  return internal::surface_by_chambers(job.clean, job.orientation, job.options, job.states,
                                       job.report, job.meter);
}

// Cells of a place would cost more than those of the whole, where these do not need any.
std::optional<Surface> in_few_places(Job& job) {
  if (job.prepared || job.nearly.surface.source.empty()) return std::nullopt;
  const auto repair_places = [](const TriangleSoup& soup, const RepairOptions& options,
                                RepairReport& report) {
    Job places{soup, options, report, StageMeter(report.stages, options.progress)};
    return by_chambers(places);
  };
  return internal::repair_in_places(std::exchange(job.nearly, {}), job.options, repair_places,
                                    job.report, job.meter);
}

std::optional<Surface> cells_everywhere(Job& job) {
  job.prepare();
  // The sheets of a soup are looked for when it is known what is solid.
  return internal::surface_by_cells(job.options.thicken.wanted() ? job.clean : std::move(job.clean),
                                    job.orientation, job.options, job.report, job.meter);
}

constexpr std::array kWays = {as_given, in_few_places, mended, by_chambers, cells_everywhere};

// By the first way that applies; the last one always does.
std::optional<Surface> first_way(Job& job) {
  std::optional<Surface> surface = job.resumed();
  if (surface) return surface;
  for (const auto& way : kWays) {
    surface = way(job);
    if (surface) break;
  }
  job.keep_repaired(*surface);
  return surface;
}

double fitting_thickness_of(const TriangleSoup& soup, const RepairOptions& options) {
  CleanReport again;
  return internal::thickness_that_fits(clean_soup(soup, again, options.progress));
}

// Whoever meant sheets by what encloses nothing can be told a thickness for them.
Surface repair_solids(const TriangleSoup& soup, const RepairOptions& options,
                      RepairReport& report) {
  Job job{soup, options, report, StageMeter(report.stages, options.progress)};
  try {
    return *first_way(job);
  } catch (const NoSolidError&) {
    report.thicken.fitting = fitting_thickness_of(soup, options);
    throw;
  }
}

// What encloses nothing is known once the soup is repaired without it. Then its sheets are made
// walls, and these are united with what is solid, by another repair.
Surface repair_with_walls(const TriangleSoup& soup, const RepairOptions& options,
                          RepairReport& report) {
  const RepairOptions first_options = internal::options_for_sheets(options);
  Job job{soup, first_options, report, StageMeter(report.stages, options.progress)};
  std::optional<Surface> solids;
  std::optional<NoSolidError> why_none;
  try {
    solids = first_way(job);
  } catch (const NoSolidError& error) {
    why_none = error;
  }
  job.meter.begin("thicken");
  const internal::SecondSoup walled = internal::add_walls(job.clean, solids, options, report);
  job.meter.end();
  if (walled.empty() && !solids) throw NoSolidError(*why_none);
  if (walled.empty()) return std::move(*solids);
  RepairReport united;
  Surface surface =
      repair_solids(walled.soup, internal::options_for_second(walled, options), united);
  internal::finish_walls(job.clean, walled, std::move(united), surface, report);
  return surface;
}

bool is_mostly_sheets(const RepairReport& report) {
  constexpr double kMostArea = 0.5;
  return report.parts.enclosing_nothing.area > kMostArea * report.input_area;
}

// Whether there are to be walls is known once the soup is repaired without any.
Surface repair_with_fitting_walls(const TriangleSoup& soup, RepairOptions options,
                                  RepairReport& report) {
  RepairOptions without = options;
  without.thicken = {};
  try {
    Surface surface = repair_solids(soup, without, report);
    if (!is_mostly_sheets(report)) return surface;
    report.thicken.fitting = fitting_thickness_of(soup, options);
  } catch (const NoSolidError&) {
    if (report.thicken.fitting == 0) throw;
  }
  options.thicken.automatic = options.thicken.is_share = false;
  options.thicken.thickness = report.thicken.fitting;
  std::vector<StageReport> stages = std::move(report.stages);
  report = {};
  report.stages = std::move(stages);
  Surface surface = repair_with_walls(soup, options, report);
  report.thicken.automatic = true;
  return surface;
}

// Soups that are repaired several times, in several ways, have no states.
RepairOptions without_states(RepairOptions options) {
  options.states = nullptr;
  return options;
}

Surface repair_what_is_there(const TriangleSoup& soup, const RepairOptions& options,
                             RepairReport& report) {
  if (options.thicken.automatic) {
    return repair_with_fitting_walls(soup, without_states(options), report);
  }
  return options.thicken.wanted() ? repair_with_walls(soup, without_states(options), report)
                                  : repair_solids(soup, options, report);
}

// Solids that are not wanted, and voids that are to be filled.
void keep_wanted_parts(const TriangleSoup& soup, const RepairOptions& options, Surface& surface,
                       RepairReport& report) {
  KeepPartsOptions keep = options.keep;
  keep.fill_voids |= options.inside.cavities == Cavities::fill;
  if (!keep.wanted()) return;
  StageMeter meter(report.stages, options.progress);
  meter.begin("keep");
  keep_parts(soup, surface, keep, report, options.progress);
  if (keep.fill_voids) report.inside.filled_voids += report.keep.voids;
}

Surface repair_whole(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report) {
  Surface surface = repair_what_is_there(soup, options, report);
  if (options.explain) report.explanation = explain_repair(soup, surface, options, report);
  if (options.seal.wanted()) {
    surface = internal::seal_solid(soup, std::move(surface), without_states(options), repair_solids,
                                   report);
  }
  if (report.sew.distance > 0) internal::note_moved_corners(soup, surface, report);
  keep_wanted_parts(soup, options, surface, report);
  internal::compare_with_input(soup, surface, report);
  return surface;
}

template <class T>
std::vector<T> of_sources(const std::vector<T>& values, const std::vector<std::uint32_t>& source) {
  std::vector<T> of;
  of.reserve(source.size());
  for (const std::uint32_t t : source) of.push_back(values[t]);
  return of;
}

// Nothing where there is nothing to join.
std::optional<JoinedSoup> joined_as_asked(const TriangleSoup& soup, const RepairOptions& options,
                                          RepairReport& report) {
  if (options.join_gaps.mode == JoinGapsMode::none) return std::nullopt;
  StageMeter meter(report.stages, options.progress);
  meter.begin("join_gaps");
  JoinGapsOptions joining = options.join_gaps;
  joining.progress = options.progress;
  std::optional<JoinedSoup> joined = join_gaps(soup, joining, report.join_gaps);
  if (joined) drop_facing_copies(soup, *joined);
  return joined;
}

// What comes out is told of the triangles that were given.
Surface repair_joined(const TriangleSoup& soup, const JoinedSoup& joined,
                      const RepairOptions& options, RepairReport& report) {
  RepairOptions of_pieces = options;
  of_pieces.explain = false;
  if (!options.opacity.empty()) of_pieces.opacity = of_sources(options.opacity, joined.source);
  if (!options.reach.empty()) of_pieces.reach = of_sources(options.reach, joined.source);
  Surface surface = repair_whole(joined.soup, of_pieces, report);
  for (std::uint32_t& source : surface.source) {
    if (source != Surface::kNoSource) source = joined.source[source];
  }
  const CleanSoup given = clean_soup(soup, report.clean, options.progress);
  report.input = examine_topology(index_triangles(given), given.points.size());
  report.spared_cells |= std::exchange(report.kept_valid, false);
  internal::note_moved_corners(soup, surface, report);
  internal::compare_with_input(soup, surface, report);
  if (options.explain) report.explanation = explain_repair(soup, surface, options, report);
  return surface;
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

Surface repair(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report) {
  RepairReport before;
  const std::optional<JoinedSoup> joined = joined_as_asked(soup, options, before);
  Surface surface =
      joined ? repair_joined(soup, *joined, options, report) : repair_whole(soup, options, report);
  report.join_gaps = before.join_gaps;
  report.stages.insert(report.stages.begin(), before.stages.begin(), before.stages.end());
  if (options.fewer.wanted()) {
    internal::take_triangles_away(soup, surface, options, report);
    if (report.fewer.collapses.collapses > 0) {
      internal::compare_with_input(soup, surface, report);
    }
  }
  return surface;
}

RepairResult repair(const TriangleSoup& soup, const RepairOptions& options) {
  RepairResult result;
  result.surface = repair(soup, options, result.report);
  return result;
}

Tree make_tree(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report) {
  const std::optional<JoinedSoup> joined = joined_as_asked(soup, options, report);
  StageMeter meter(report.stages, options.progress);
  CleanSoup clean = internal::close_soup(joined ? joined->soup : soup, options, report, meter);
  for (Triangle& triangle : clean.triangles) {
    if (joined && triangle.source != Triangle::kNoSource) {
      triangle.source = joined->source[triangle.source];
    }
  }
  return internal::divide_space(std::move(clean), options, report, meter);
}

void label_tree(Tree& tree, const RepairOptions& options, RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  const Orientation orientation = internal::orient_soup(tree.input, options, report, meter);
  const internal::CoveredCells covered =
      internal::make_cells(tree, orientation.winding, options, report, meter);
  const CellLabels labels = internal::find_solid(covered, orientation, options, report, meter);
  for (CellId c(0u); c < covered.complex.cells.end_id(); ++c.value) {
    tree.leaves[covered.complex.cells[c].leaf] = {
        labels.solid[c.index()] != 0 ? Label::solid : Label::empty, labels.confidence[c.index()]};
  }
}

Surface extract_mesh(const Tree& tree, const RepairOptions& options, RepairReport& report) {
  require_labels(tree);
  StageMeter meter(report.stages, options.progress);
  internal::CoveredCells covered =
      internal::make_cells(tree, windings_of(tree.input), options, report, meter);
  const std::vector<char> solid = solid_cells(tree, covered.complex);
  return internal::make_surface(std::move(covered), solid, options, report, meter);
}

std::optional<Surface> extract_mesh(const CleanSoup& soup, const Arrangement& arrangement,
                                    const std::vector<char>& solid, const RepairOptions& options,
                                    RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  meter.begin("extract");
  std::optional<Surface> surface =
      internal::boundary_of_chambers(soup, arrangement, solid, options, report);
  if (!surface) return std::nullopt;
  surface = internal::finish_surface(soup, std::move(*surface), options, report, meter);
  if (options.certify.wanted && !report.certify.passed()) return std::nullopt;
  return surface;
}

Surface extract_mesh(CleanSoup soup, const SolidCells& solid, const RepairOptions& options,
                     RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  Tree tree = internal::divide_space(std::move(soup), options, report, meter);
  internal::CoveredCells covered =
      internal::make_cells(tree, windings_of(tree.input), options, report, meter);
  tree.nodes = {};
  tree.node_triangles = {};
  meter.begin("links");
  CellGraph graph(covered.complex, covered.cover, options.progress, covered.layers);
  meter.begin("inside");
  const std::vector<char> flags = solid(graph);
  if (std::find(flags.begin(), flags.end(), 1) == flags.end()) return {};
  return internal::make_surface(std::move(covered), flags, options, report, meter);
}

}  // namespace meshrepair
