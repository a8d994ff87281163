// SPDX-License-Identifier: MIT
#include "report/report_sections.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "report/distance_report.h"
#include "report/findings.h"
#include "report/thickness_report.h"

namespace meshrepair {
namespace {

bool was_begun(const RepairReport& repair, std::string_view stage) {
  return std::any_of(repair.stages.begin(), repair.stages.end(),
                     [&](const StageReport& s) { return s.name == stage; });
}

Json packed_of(const PackedFile& packed) {
  if (packed.packing == Packing::none) return nullptr;
  return {{"in", packing_name(packed.packing)},
          {"bytes", packed.bytes},
          {"entry", packed.entry.empty() ? Json() : Json(packed.entry)}};
}

Json names_of(const NamesInFile& names) {
  return {{"files", names.files}, {"pictures", names.pictures}, {"outside", names.outside}};
}

Json volumes_of(const std::vector<ModelVolume>& volumes) {
  Json list = Json::array();
  for (const ModelVolume& volume : volumes) {
    list.push_back({{"name", volume.name},
                    {"object", volume.object},
                    {"role", role_name(volume.role)},
                    {"printed", volume.printed},
                    {"triangles", volume.triangles},
                    {"copies", volume.copies},
                    {"fate", fate_name(volume.fate)}});
  }
  return list;
}

Json section_of(const ReadReport& read) {
  return {{"format", format_name(read.format)},
          {"bytes", read.bytes},
          {"unit", read.unit ? Json(unit_name(*read.unit)) : Json()},
          {"packed", packed_of(read.packed)},
          {"declared_triangles", read.declared_triangles},
          {"polygons", read.polygons},
          {"bad_faces", read.bad_faces},
          {"bad_points", read.bad_points},
          {"missing_faces", read.missing_faces},
          {"trailing_bytes", read.trailing_bytes},
          {"names", names_of(read.names)},
          {"volumes", volumes_of(read.volumes)},
          {"warnings", texts_of(read.warnings)}};
}

Json section_of(const PointReadReport& read) {
  return {{"format", format_name(read.format)},
          {"bytes", read.bytes},
          {"packed", packed_of(read.packed)},
          {"declared_points", read.declared_points},
          {"bad_points", read.bad_points},
          {"missing_points", read.missing_points},
          {"trailing_bytes", read.trailing_bytes},
          {"normals", read.normals},
          {"colours", read.colours},
          {"warnings", texts_of(read.warnings)}};
}

Json section_of(const PointSoupReport& points) {
  return {{"points_in", points.points_in},
          {"not_finite", points.not_finite},
          {"duplicates", points.duplicates},
          {"outliers", points.outliers},
          {"thinned", points.thinned},
          {"points", points.points},
          {"normals_used", points.normals_used},
          {"spacing", points.spacing},
          {"smallest_spacing", points.smallest_spacing},
          {"largest_spacing", points.largest_spacing},
          {"farthest_move", points.farthest_move},
          {"triangles_by_votes", points.by_votes},
          {"disagreed_triangles", points.disagreed},
          {"loose_triangles", points.loose},
          {"crumb_triangles", points.crumbs},
          {"triangles", points.triangles}};
}

Json section_of(const std::vector<PointTry>& tries) {
  constexpr std::array<std::string_view, 4> kEnds = {"noisy", "open", "faulty", "solid"};
  Json list = Json::array();
  for (const PointTry& attempt : tries) {
    list.push_back({{"project", attempt.project},
                    {"neighbours", attempt.neighbours},
                    {"base", attempt.base},
                    {"walls", attempt.walls},
                    {"agreement", attempt.agreement},
                    {"end", kEnds[static_cast<std::size_t>(attempt.end)]}});
  }
  return list;
}

Json section_of(const ScanBaseReport& base) {
  return {{"floor", base.floor},
          {"parts", base.parts},
          {"dropped_triangles", base.dropped_triangles},
          {"skirt_triangles", base.skirt_triangles}};
}

Json section_of(const TreeFacts& tree) {
  return {{"format", "BSP tree"},      {"triangles", tree.triangles},
          {"nodes", tree.nodes},       {"leaves", tree.leaves},
          {"labelled", tree.labelled}, {"solid_leaves", tree.solid_leaves}};
}

Json section_of(const CleanReport& clean) {
  return {{"triangles_in", clean.triangles_in},
          {"dropped_not_finite", clean.dropped_not_finite},
          {"dropped_degenerate", clean.dropped_degenerate},
          {"dropped_below_grid", clean.dropped_below_grid},
          {"duplicates", clean.duplicates},
          {"opposite_duplicates", clean.opposite_duplicates},
          {"joined_points", clean.joined_points},
          {"grid_unit", clean.grid_unit}};
}

Json defects_of(const RepairReport& repair) {
  const Topology& input = repair.input;
  return {{"triangles", input.triangles},
          {"edges", input.edges},
          {"open_edges", input.open_edges},
          {"nonmanifold_edges", input.nonmanifold_edges},
          {"inconsistent_edges", input.inconsistent_edges},
          {"nonmanifold_vertices", input.nonmanifold_vertices},
          {"parts", input.parts},
          {"duplicates", repair.clean.duplicates + repair.clean.opposite_duplicates},
          {"degenerate", repair.clean.dropped_degenerate},
          {"not_finite", repair.clean.dropped_not_finite},
          {"area", repair.input_area},
          {"volume", repair.input_volume}};
}

Json section_of(const JoinGapsReport& gaps) {
  return {{"distance", gaps.distance},
          {"pairs", gaps.pairs},
          {"widest_gap", gaps.widest_gap},
          {"joined_points", gaps.joined_points},
          {"new_points", gaps.new_points},
          {"farthest_move", gaps.farthest_move},
          {"left", gaps.left}};
}

Json section_of(const SewReport& sew) {
  return {{"distance", sew.distance},
          {"widest_gap", sew.widest_gap},
          {"open_edges", sew.open_edges},
          {"sewn_edges", sew.sewn_edges},
          {"joined_points", sew.joined_points},
          {"split_edges", sew.split_edges},
          {"farthest_move", sew.farthest_move},
          {"lost_triangles", sew.lost_triangles},
          {"refused_distance", sew.refused_distance}};
}

Json section_of(const HoleReport& holes) {
  return {{"loops", holes.loops},
          {"closed", holes.closed},
          {"curved", holes.curved},
          {"rings", holes.rings},
          {"slits", holes.slits},
          {"too_large", holes.too_large},
          {"stray_edges", holes.stray_edges},
          {"triangles", holes.triangles},
          {"area", holes.area},
          {"largest_area", holes.largest_area},
          {"longest_loop", holes.longest_loop}};
}

Json section_of(const SealReport& seal) {
  return {{"automatic", seal.automatic},
          {"double_walls", seal.double_walls},
          {"size", seal.size},
          {"step", seal.step},
          {"openings", seal.openings},
          {"patches_area", seal.patches_area},
          {"filled_volume", seal.filled_volume},
          {"leaks", seal.leaks},
          {"cannot_cut", seal.cannot_cut}};
}

Json section_of(const ThickenReport& thicken) {
  return {{"thickness", thicken.thickness},
          {"automatic", thicken.automatic},
          {"side", thicken_side_name(thicken.side)},
          {"triangles", thicken.triangles},
          {"sheets", thicken.sheets},
          {"area", thicken.area},
          {"folds", thicken.folds},
          {"corners", thicken.corners},
          {"wall_triangles", thicken.wall_triangles},
          {"solid_volume", thicken.solid_volume}};
}

Json vector_of(const Vec3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

// A bound that was not found is null.
Json section_of(const OffsetReport& offset) {
  return {{"distance", offset.distance},
          {"least", offset.least},
          {"most", std::isfinite(offset.most) ? Json(offset.most) : Json()},
          {"unproven", offset.unproven},
          {"volume_before", offset.volume_before},
          {"cells", offset.cells}};
}

// The same, and what drains leave where there are none.
Json section_of(const HollowReport& hollow) {
  Json cavities = Json::array();
  bool has_drains = false;
  for (const Cavity& cavity : hollow.cavities) {
    has_drains = has_drains || !cavity.drains.empty();
    Json drains = Json::array();
    for (const Drain& drain : cavity.drains) {
      drains.push_back({{"at", vector_of(drain.at)},
                        {"direction", vector_of(drain.direction)},
                        {"beside", drain.beside}});
    }
    cavities.push_back({{"volume", cavity.volume},
                        {"diameter", cavity.diameter},
                        {"opens", cavity.opens},
                        {"drains", std::move(drains)}});
  }
  return {{"wall", hollow.wall},
          {"least", hollow.least},
          {"most", std::isfinite(hollow.most) ? Json(hollow.most) : Json()},
          {"unproven", hollow.unproven},
          {"drain", hollow.drain},
          {"beside_drains", has_drains ? Json(hollow.beside_drains) : Json()},
          {"cavities", std::move(cavities)},
          {"least_diameter", hollow.least_diameter},
          {"left_full", hollow.left_full},
          {"left_full_volume", hollow.left_full_volume},
          {"volume_before", hollow.volume_before},
          {"cells", hollow.cells},
          {"finest", hollow.finest}};
}

Json section_of(const BuildTreeReport& tree) {
  return {{"nodes", tree.nodes},         {"leaves", tree.leaves},
          {"depth", tree.depth},         {"spatial_cuts", tree.spatial_cuts},
          {"fragments", tree.fragments}, {"lost_fragments", tree.lost_fragments}};
}

Json section_of(const OrientReport& orient) {
  return {{"parts", orient.parts},
          {"turned_triangles", orient.turned_triangles},
          {"doubtful_parts", orient.doubtful_parts},
          {"unorientable_parts", orient.unorientable_parts}};
}

Json section_of(const ArrangeReport& arrange) {
  return {{"cut_triangles", arrange.cut_triangles},
          {"facets", arrange.facets},
          {"new_points", arrange.new_points},
          {"chambers", arrange.chambers},
          {"regions", arrange.regions},
          {"singular_edges", arrange.singular_edges},
          {"middle_vertices", arrange.middle_vertices}};
}

Json cells_of(const RepairReport& repair) {
  const ClipReport& clip = repair.clip;
  const bool exact = repair.predicates == Predicates::exact;
  return {{"predicates", predicates_name(repair.predicates)},
          {"eps", exact ? Json() : Json(repair.epsilon)},
          {"cells", repair.cells},
          {"facets", repair.facets},
          {"links", repair.links},
          {"clips", clip.clips},
          {"fallbacks",
           {{"loose_points", clip.loose_points},
            {"several_groups", clip.several_groups},
            {"region_floods", clip.region_floods},
            {"several_regions", clip.several_regions},
            {"forced_cuts", clip.forced_cuts}}},
          {"opaque_facets", repair.cover.opaque_facets},
          {"split_facets", repair.cover.split_facets},
          {"guessed_facets", repair.cover.guessed_facets}};
}

Json section_of(const InsideReport& inside) {
  return {{"asked", rule_name(inside.asked)},
          {"used", rule_name(inside.used)},
          {"reason", inside.reason},
          {"exact", inside.exact},
          {"contradictions", inside.contradictions},
          {"unknowns", inside.solve.unknowns},
          {"iterations", inside.solve.iterations},
          {"residual", inside.solve.residual},
          {"converged", inside.solve.converged},
          {"winding_distance", inside.winding_distance},
          {"winding_contradiction", inside.winding_contradiction},
          {"loose_share", inside.loose_share},
          {"turned_parts", inside.turned_parts},
          {"doubtful_parts", inside.doubtful_parts},
          {"cavity_walls", inside.cavity_walls},
          {"poking_walls", inside.poking_walls},
          {"poking_share", inside.poking_share},
          {"other", inside.other == InsideRule::automatic ? Json() : Json(rule_name(inside.other))},
          {"left_out_folds", inside.left_out_folds},
          {"filled_voids", inside.filled_voids},
          {"solid_cells", inside.solid_cells}};
}

Json section_of(const ExtractReport& extract) {
  return {{"boundary_facets", extract.boundary_facets},
          {"unmerged_triangles", extract.unmerged_triangles},
          {"regions", extract.regions},
          {"singular_edges", extract.singular_edges},
          {"singular_vertices", extract.singular_vertices},
          {"middle_vertices", extract.middle_vertices},
          {"polygons_apart", extract.polygons_apart}};
}

Json section_of(const SimplifyReport& simplify) {
  return {{"removed_points", simplify.removed_points},
          {"removed_triangles", simplify.removed_triangles},
          {"distance_at_most", simplify.distance},
          {"points_to_stay", simplify.points_to_stay},
          {"rounds", simplify.rounds}};
}

Json section_of(const RemovedPart& part) {
  return {{"what", part.is_void ? "void" : "solid"},
          {"volume", part.volume},
          {"centre", {part.centre.x(), part.centre.y(), part.centre.z()}},
          {"triangles", part.triangles}};
}

Json section_of(const FewerTrianglesReport& fewer) {
  return {{"done", fewer.done},
          {"asked", fewer.asked},
          {"before", fewer.before},
          {"volume_before", fewer.volume_before},
          {"after", fewer.after},
          {"volume_after", fewer.volume_after},
          {"max_error", fewer.most_distance},
          {"unproven", fewer.is_unproven},
          {"collapses", fewer.collapses.collapses},
          {"would_change_topology", fewer.collapses.would_change_topology},
          {"would_break_seam", fewer.collapses.would_break_seam},
          {"would_fold", fewer.collapses.would_fold},
          {"would_intersect", fewer.collapses.would_meet},
          {"would_exceed_error", fewer.collapses.would_part}};
}

Json section_of(const KeepPartsReport& keep) {
  constexpr std::size_t kMostListed = 100;
  std::array<std::size_t, 2> count = {0, 0};
  std::array<double, 2> volume = {0, 0};
  Json first = Json::array();
  for (const RemovedPart& part : keep.removed) {
    const std::size_t kind = part.is_void ? 1 : 0;
    ++count[kind];
    volume[kind] += part.volume;
    if (first.size() < kMostListed) first.push_back(section_of(part));
  }
  return {{"done", keep.done},           {"solids", keep.solids},
          {"voids", keep.voids},         {"removed_solids", count[0]},
          {"removed_volume", volume[0]}, {"filled_voids", count[1]},
          {"filled_volume", volume[1]},  {"first_removed", std::move(first)}};
}

Json section_of(const PartsAndArea& parts) {
  return {{"parts", parts.parts}, {"area", parts.area}};
}

Json removed_of(const RepairReport& repair) {
  const PartFates& parts = repair.parts;
  return {{"enclosing_nothing", section_of(parts.enclosing_nothing)},
          {"inside_solid", section_of(parts.inside_solid)},
          {"triangles_inside", parts.inside_triangles},
          {"triangles_outside", parts.outside_triangles},
          {"lost_area", repair.lost_area},
          {"open_regions", repair.open_regions},
          {"crumbs", repair.crumbs},
          {"slit_cells", repair.thin_cells.filled},
          {"fin_cells", repair.thin_cells.emptied},
          {"slits_area", repair.slits_area},
          {"fins_area", repair.fins_area}};
}

const char* verdict(bool holds) { return holds ? "PASS" : "FAIL"; }

Json certificate_of(const RepairReport& repair) {
  const CertifyReport& certified = repair.certify;
  return {{"closed", verdict(repair.output.closed())},
          {"manifold", verdict(repair.output.manifold())},
          {"oriented", verdict(repair.output.oriented() && certified.inside_out_parts == 0)},
          {"no_self_intersections", verdict(certified.done && certified.pairs == 0)},
          {"no_degenerate_triangles", verdict(certified.done && certified.degenerate == 0)},
          {"intersecting_pairs", certified.pairs},
          {"degenerate_triangles", certified.degenerate},
          {"intersecting_pairs_at_first", certified.pairs_at_first},
          {"rounds", certified.rounds},
          {"snapped_points", certified.snapped_points},
          {"dropped_parts", certified.dropped_parts},
          {"dropped_share", certified.dropped_share},
          {"inside_out_parts", certified.inside_out_parts},
          {"joined_points", certified.joined_points}};
}

Json result_of(const Findings& findings) {
  const RepairReport& repair = findings.repair;
  const Topology& output = repair.output;
  return {{"triangles", output.triangles},
          {"points", findings.output_points},
          {"untouched_triangles", repair.triangles.untouched},
          {"cut_triangles", repair.triangles.cut},
          {"rounded_triangles", repair.triangles.rounded},
          {"same_triangles", repair.same_triangles},
          {"kept_as_given", repair.kept_valid},
          {"spared_cells", repair.spared_cells},
          {"parts", output.parts},
          {"dropped_solids", findings.dropped_solids},
          {"closed", output.closed()},
          {"manifold", output.manifold()},
          {"oriented", output.oriented()},
          {"volume", repair.output_volume},
          {"area", repair.output_area},
          {"closing_area", repair.closing_area}};
}

}  // namespace

Json texts_of(const std::vector<Warning>& warnings) {
  Json texts = Json::array();
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

Json read_section(const ReadReport& read) { return section_of(read); }

Json stages_section(const std::vector<StageReport>& reports) {
  Json stages = Json::array();
  for (const StageReport& stage : reports) {
    stages.push_back({{"name", stage.name},
                      {"seconds", stage.seconds},
                      {"cpu_seconds", stage.cpu_seconds},
                      {"peak_bytes", stage.peak_bytes}});
  }
  return stages;
}

namespace {

void add_what_was_taken_away(const RepairReport& repair, JsonReport& report) {
  if (was_begun(repair, "simplify")) {
    report.set_section("simplify", section_of(repair.simplify));
  }
  if (repair.keep.asked) report.set_section("keep", section_of(repair.keep));
  if (repair.fewer.before > 0) report.set_section("fewer", section_of(repair.fewer));
}

void add_walls(const Findings& findings, JsonReport& report) {
  if (findings.offset.distance != 0) report.set_section("offset", section_of(findings.offset));
  if (findings.hollow.wall > 0) report.set_section("hollow", section_of(findings.hollow));
  if (!findings.thin) return;
  ThinReport few = *findings.thin;
  keep_places(few, ThinOptions().most_places);
  report.set_section("thickness", thickness_section(few));
}

}  // namespace

void add_sections(const Findings& findings, JsonReport& report) {
  const RepairReport& repair = findings.repair;
  if (const Purpose& purpose = findings.purpose; !purpose.name.empty()) {
    report.set_section(
        "purpose",
        {{"name", purpose.name}, {"options", purpose.options}, {"overridden", purpose.overridden}});
  }
  if (findings.mesh_read) report.set_section("read", section_of(*findings.mesh_read));
  if (findings.origin) {
    const Vec3d& origin = *findings.origin;
    report.set_section("origin", {{"offset", {origin.x(), origin.y(), origin.z()}},
                                  {"in_scene", findings.is_origin_in_places}});
  }
  if (findings.points_read) report.set_section("read", section_of(*findings.points_read));
  if (findings.point_soup) {
    Json points = section_of(*findings.point_soup);
    if (!findings.tries.empty()) points["tries"] = section_of(findings.tries);
    if (was_begun(repair, "check")) points["points_in_result"] = findings.points_in_result;
    if (findings.joined_columns > 0) points["joined_columns"] = findings.joined_columns;
    report.set_section("points", std::move(points));
  }
  const auto has = [&](std::string_view stage) {
    return repair.thicken.triangles > 0 || repair.kept_valid || repair.spared_cells ||
           was_begun(repair, stage);
  };
  if (findings.scan_base) report.set_section("base", section_of(*findings.scan_base));
  if (findings.tree_read) report.set_section("read", section_of(*findings.tree_read));
  if (has("clean")) {
    report.set_section("clean", section_of(repair.clean));
    report.set_section("defects", defects_of(repair));
  }
  if (was_begun(repair, "join_gaps")) {
    report.set_section("join_gaps", section_of(repair.join_gaps));
  }
  if (was_begun(repair, "sew")) report.set_section("sew", section_of(repair.sew));
  if (has("tree") || was_begun(repair, "arrange"))
    report.set_section("holes", section_of(repair.holes));
  if (was_begun(repair, "seal")) report.set_section("seal", section_of(repair.seal));
  if (repair.thicken.triangles > 0) report.set_section("thicken", section_of(repair.thicken));
  if (was_begun(repair, "tree")) report.set_section("tree", section_of(repair.tree));
  if (was_begun(repair, "orient")) report.set_section("orient", section_of(repair.orient));
  if (repair.arrange.chambers > 0) report.set_section("arrange", section_of(repair.arrange));
  if (was_begun(repair, "cells")) report.set_section("cells", cells_of(repair));
  if (has("inside")) report.set_section("inside", section_of(repair.inside));
  if (has("extract")) {
    report.set_section("removed", removed_of(repair));
    report.set_section("extract", section_of(repair.extract));
  }
  add_what_was_taken_away(repair, report);
  add_walls(findings, report);
  // meshcheck has a stage of this name, too, but no result.
  if (has("extract") && was_begun(repair, "check")) {
    report.set_section("result", result_of(findings));
    report.set_section("certificate", certificate_of(repair));
  }
  if (!findings.required.is_null()) report.set_section("required", findings.required);
  if (findings.fidelity) report.set_section("distance", distance_section(*findings.fidelity));
  report.set_stages(stages_section(repair.stages));
}

}  // namespace meshrepair
