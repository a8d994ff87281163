// SPDX-License-Identifier: MIT
#include "steps/repair_command.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>

#include "options/numbers.h"
#include "options/purposes.h"
#include "options/repair_options.h"
#include "page/html_report.h"
#include "pictures/explanation_file.h"
#include "pictures/picture_steps.h"
#include "program/program.h"
#include "report/findings.h"
#include "steps/check_steps.h"
#include "steps/guarantees.h"
#include "steps/mesh_steps.h"
#include "steps/negative_steps.h"
#include "steps/scene_steps.h"
#include "steps/step_options.h"
#include "summary/warnings.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

// For developers, for comparisons, and for points that the defaults do not fit.
constexpr std::array<const char*, 17> kRareOptions = {
    "--touching",        "--simplify",     "--always",       "--predicates", "--eps",
    "--sources",         "--picture-size", "--picture-view", "--show-as",    "--html-triangles",
    "--picture-colours", "--votes",        "--reach",        "--neighbours", "--outliers",
    "--no-normals",      "--no-advice"};

// Who meant sheets can have walls.
Surface repair_or_advise(AnySoup& input, const PointOptions& points, const RepairOptions& options,
                         Run& run, Findings& findings) {
  try {
    return repair_any(input, points, options, run, findings);
  } catch (const NoSolidError& error) {
    if (input.cloud) throw;
    throw NoSolidError(error.what() + advice_to_thicken(findings.repair));
  }
}

// It is where the coordinates of IN have it.
void move_floor(const Vec3d& origin, ScanBaseOptions& base) {
  if (base.floor) *base.floor -= origin[base.axis];
}

// Those that are in the units of IN.
void scale_lengths(double factor, RepairOptions& options, ScanBaseOptions& base) {
  if (!options.sew.is_share) options.sew.distance *= factor;
  if (!options.join_gaps.is_share) options.join_gaps.distance *= factor;
  if (!options.seal.is_share) options.seal.size *= factor;
  if (!options.thicken.is_share) options.thicken.thickness *= factor;
  if (!options.fewer.distance_is_share) options.fewer.distance *= factor;
  if (!base.is_share) base.depth *= factor;
  if (base.floor) *base.floor *= factor;
}

// Of points, and of sheets that get walls, several soups are tried.
void drop_states_of_many_soups(const AnySoup& input, RepairOptions& options) {
  if (options.states == nullptr || !(input.cloud || options.thicken.wanted())) return;
  warn("--resume", {WarningCode::states_not_saved,
                    std::string("saves nothing if ") +
                        (input.cloud ? "points become a mesh" : "sheets get walls")});
  options.states = nullptr;
}

// Of each triangle that of the file, if `before` has those of the soup that was repaired.
std::vector<std::uint32_t> sources_in_file(const Surface& surface,
                                           const std::vector<std::uint32_t>& before) {
  std::vector<std::uint32_t> sources;
  if (before.empty()) return sources;
  for (const std::uint32_t t : surface.source) {
    sources.push_back(t == Surface::kNoSource ? t : before[t]);
  }
  return sources;
}

void fit_to_input(const AnySoup& input, const RepairCommand& command, RepairOptions& options) {
  if (!input.attributes.is_bare()) options.fewer.attributes = &input.attributes;
  keep_attributes(input.soup, input.attributes, options);
  options.all_cells = command.always;
  const StepOptions& steps = command.steps;
  drop_states_of_many_soups(input, options);
  options.explain = !steps.explained.empty() || steps.html.wanted() || steps.picture.painted;
}

// Reduced before, the offset would be that of another solid; reduced afterwards, farther than said.
void refuse_to_reduce_offsets(const RepairCommand& command) {
  if (command.offset.distance == 0 || !command.steps.repair.fewer.wanted()) return;
  throw UsageError(
      "--offset: cannot be used with --triangles or --max-error; reduce OUT in a run of its own");
}

// What is done with one solid only.
void refuse_scenes(const RepairCommand& command) {
  const auto refuse = [](bool is_asked, const std::string& option) {
    if (is_asked) throw UsageError(option + ": cannot be used with --scene each");
  };
  refuse(command.points.repair.base, "--base");
  refuse(command.offset.distance != 0, "--offset");
  refuse(command.hollow.options.wanted(), "--hollow");
  refuse(command.thin.limit > 0, "--thickness");
}

// A page shows more places than the report has.
ThinOptions thin_places_of(const RepairCommand& command) {
  ThinOptions thin = command.thin;
  if (!command.steps.html.wanted()) return thin;
  thin.mark_triangles = true;
  thin.most_places = kMostPagePlaces;
  return thin;
}

// Names of parts are what boundary conditions and the like hang on: they do not go without a word.
void warn_of_lost_groups(const AnySoup& input, SoupFormat format, const AssetOptions& assets,
                         const Findings& findings) {
  if (input.attributes.groups.names.size() < 2) return;
  Attributes names;
  names.groups = input.attributes.groups;
  names = chosen_for(std::nullopt, assets, std::move(names));
  warn_of_lost(input.soup, names, held_by(format, names, assets.by_mesh), format, findings);
}

}  // namespace

void add_repair_command(CommandLine& app, RepairCommand& command) {
  StepOptions& options = command.steps;
  add_purpose_option(app, options.purpose);
  add_inside_options(app, options.repair.inside);
  add_sew_option(app, options.repair.sew);
  add_join_gaps_option(app, options.repair.join_gaps);
  add_seal_option(app, options.repair.seal);
  add_holes_option(app, options.repair.holes);
  const CommandOption& max_hole = add_max_hole_option(app, options.repair.holes);
  add_thicken_options(app, max_hole, options.repair.thicken);
  add_keep_options(app, options.repair.keep);
  add_offset_option(app, command.offset);
  add_hollow_options(app, command.hollow);
  add_triangles_option(app, options.repair.fewer);
  add_max_error_option(app, options.repair.fewer);
  add_touching_option(app, options.repair.extract.touching);
  add_simplify_option(app, options.repair.simplify);
  add_scene_option(app, options.assets);
  add_negative_option(app, command.negative);
  const CommandOption* always =
      app.add_flag("--always", command.always,
                   "Run all steps, even if the mesh already bounds a solid or needs only holes\n"
                   "filled and triangles flipped")
          ->group("Repair");
  add_predicates_options(app, options.repair, always);
  add_format_option(app, options.format);
  add_sources_option(app, options.sources);
  add_staging_option(app, options.staging);
  add_root_option(app, options.assets);
  add_drop_option(app, options.assets);
  add_beam_sides_option(app, options.assets);
  add_units_option(app, options.assets);
  add_origin_options(app, options.origin);
  add_certify_options(app, options.repair.certify, options.strict);
  add_require_option(app, options.required);
  add_length_option(
      app, "--thickness", command.thin.limit, command.thin.is_share,
      "Warn of walls, pins, gaps and sharp edges of the result that are thinner than this, in\n"
      "units of IN, or as a percentage of the result's bounding box diagonal, such as 1%, and "
      "print where",
      "Output");
  add_explain_option(app, options.explained);
  add_picture_options(app, options.picture, "IN and OUT side by side");
  add_colours_option(app, options.picture, "fates", "those of --explain");
  add_show_options(app, options.picture, "IN and OUT", "; otherwise print a bar of what changed");
  add_html_options(app, options.html, "IN and OUT with all defects");
  add_point_repair_options(app, command.points);
  for (const char* const name : kRareOptions) app.option(name).rare();
}

void repair_file(const RepairCommand& command, Run& run, Findings& findings) {
  const StepOptions& options = command.steps;
  refuse_to_reduce_offsets(command);
  WriteOptions format = mesh_format(options);
  ReadOptions reading = reading_for(*format.format, options.assets, read_options(run));
  // Pictures and pages show also what the output cannot hold.
  const bool is_shown = options.picture.wanted() || options.html.wanted();
  if (is_shown) reading.attributes = !options.assets.drops_all();
  reading.negative = command.negative;
  AnySoup input = read_any_stage(command.points, reading, run, findings);
  move_origin_stage(options.origin, *format.format, options.repair.certify.precision, input,
                    findings);
  const std::vector<std::uint32_t> before =
      subtract_negatives_stage(input, options.repair, run, findings);
  check_picture(options.picture, input.attributes);
  const Attributes given = is_shown ? input.attributes : Attributes();
  warn_of_lost_groups(input, *format.format, options.assets, findings);
  input.attributes = chosen_for(format.format, options.assets, std::move(input.attributes));
  RepairOptions repair_options = certified_for(*format.format, options.repair);
  PointOptions points = command.points;
  if (findings.origin) move_floor(*findings.origin, points.repair.scan_base);
  const double scale = scale_to_unit(*format.format, options.assets, findings.unit);
  scale_lengths(scale, repair_options, points.repair.scan_base);
  if (findings.origin) *findings.origin *= scale;
  findings.unit = brought_to_unit(*format.format, options.assets, findings.unit, input.soup);
  format.extras.unit = findings.unit;
  fit_to_input(input, command, repair_options);
  if (!input.scene.meshes.empty()) {
    refuse_scenes(command);
    return repair_scene(input, given, repair_options, format, options, run, findings);
  }
  Surface surface = repair_or_advise(input, points, repair_options, run, findings);
  offset_stage(command.offset, scale, repair_options, input.attributes, surface, run, findings);
  measure_distance_stage(input.soup, surface, repair_options.certify.precision, run, findings);
  Attributes attributes =
      transfer_attributes_stage(input.soup, input.attributes, surface, run, findings);
  HollowRequest hollow = command.hollow;
  hollow.scale_and_move(scale, findings);
  hollow_stage(hollow, repair_options, surface, attributes, run, findings);
  thickness_stage(surface.mesh, thin_places_of(command), scale, run, findings);
  const std::vector<std::uint32_t> sources = sources_in_file(surface, before);
  format.extras.sources = sources;
  write_mesh_stage(surface, attributes, format, options, run, findings);
  write_explanation_stage(options.explained, {input.soup, {}}, {surface.mesh, {}}, run, findings);
  const std::array<Attributes, 2> fates = painted_fates(options.picture, findings);
  draw_picture_stage(options.picture, up_of(findings), {options.input},
                     {{input.soup, options.picture.painted ? fates[0] : given},
                      {surface.mesh, options.picture.painted ? fates[1] : attributes}},
                     run, findings);
  write_html_stage(options.html, up_of(findings), {input.soup, given}, {surface.mesh, attributes},
                   run, findings);
}

RepairedMesh repair_in_memory(AnySoup& input, const RepairCommand& command, Run& run,
                              Findings& findings) {
  const StepOptions& options = command.steps;
  refuse_to_reduce_offsets(command);
  // OBJ keeps indices and all digits, as memory does.
  const SoupFormat format = options.format.value_or(SoupFormat::obj);
  input.attributes = chosen_for(options.format, options.assets, std::move(input.attributes));
  RepairOptions repair_options = certified_for(format, options.repair);
  fit_to_input(input, command, repair_options);
  RepairedMesh result;
  result.surface = repair_or_advise(input, command.points, repair_options, run, findings);
  offset_stage(command.offset, 1, repair_options, input.attributes, result.surface, run, findings);
  measure_distance_stage(input.soup, result.surface, repair_options.certify.precision, run,
                         findings);
  result.attributes =
      transfer_attributes_stage(input.soup, input.attributes, result.surface, run, findings);
  hollow_stage(command.hollow, repair_options, result.surface, result.attributes, run, findings);
  thickness_stage(result.surface.mesh, command.thin, 1, run, findings);
  look_at_file(result.surface, format, findings);
  findings.missing_guarantees = missing_guarantees(findings, format);
  warn_of_findings(findings);
  judge_requirements(options.required, findings);
  return result;
}

}  // namespace meshrepair
