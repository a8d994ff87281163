// SPDX-License-Identifier: MIT
// bspbool A B ... --op OPERATION -o OUT: Boolean operations on solids.
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>
#include <boolean/boolean.h>

#include "options/command_line.h"
#include "options/file_kinds.h"
#include "options/repair_options.h"
#include "options/show_requests.h"
#include "page/boolean_page.h"
#include "pictures/picture_steps.h"
#include "program/command_files.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/report_sections.h"
#include "report/words.h"
#include "steps/boolean_steps.h"
#include "steps/common_unit.h"
#include "steps/guarantees.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"
#include "summary/summary.h"
#include "terminal/logging.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

struct BoolOptions {
  BooleanCommand command;
  bool output_has_unit = false;
  bool carries_attributes = false;  // the output can hold some
};

bool is_tree_name(const std::string& name) {
  return lower_extension(without_packing(name).string()) == ".bsp";
}

// The meshes as they are in their files.
struct GivenMeshes : JoinedMeshes {
  View::Up up = View::Up::y;  // unless some mesh has z up
  std::vector<GivenOperand> operands;
};

// What all operands have in common.
struct Intake {
  CommonUnit unit;
  CommonOrigin origin;
  GivenMeshes given;
};

// Whether anybody is to see the operands.
bool shows_operands(const BoolOptions& options) {
  return options.command.step.picture.wanted() || options.command.step.html.wanted();
}

// The mesh as it is in the file, if it is to be seen.
void keep_given(const BoolOptions& options, const TriangleSoup& soup, const Attributes& attributes,
                Intake& intake) {
  if (!shows_operands(options)) return;
  intake.given.add(soup, attributes);
  GivenOperand& operand = intake.given.operands.back();
  operand.points = soup.points.size();
  operand.triangles = soup.triangles.size();
}

// `intake.given` gets the mesh as it is in the file.
Operand read_mesh_operand(const BoolOptions& options, const RepairOptions& repair_options, Run& run,
                          Findings& findings, Intake& intake) {
  const PictureRequest& picture = options.command.step.picture;
  ReadOptions reading = read_options(run);
  reading.may_be_empty = true;
  reading.attributes = !options.command.step.assets.drops_all() &&
                       (options.carries_attributes || shows_operands(options));
  auto [soup, attributes, scene, report, placed] = read_mesh_stage(reading, run, findings);
  const double scale = intake.unit.apply(findings.unit, soup);
  if (report.offset) *report.offset *= scale;
  intake.origin.apply(report.offset, soup, findings);
  check_picture(picture, attributes);
  keep_given(options, soup, attributes, intake);
  if (!options.carries_attributes) attributes = {};
  return make_operand(std::move(soup), std::move(attributes), repair_options, run, findings);
}

// A mesh that is no solid is repaired, a tree without labels gets some. One in which nothing is
// solid is the empty solid, and so is a mesh of nothing.
Operand read_operand(const BoolOptions& options, Run& run, Findings& findings, Intake& intake) {
  const RepairOptions repair_options = operand_options(options.command, run);
  if (!is_tree_name(findings.input)) {
    return read_mesh_operand(options, repair_options, run, findings, intake);
  }
  Tree tree = read_tree_stage(run, findings);
  if (!findings.tree_read->labelled) {
    label_tree(tree, repair_options, findings.repair);
  } else if (findings.tree_read->solid_leaves == 0) {
    return {};
  }
  TriangleSoup solid = extract_mesh(tree, repair_options, findings.repair).mesh;
  keep_given(options, solid, {}, intake);
  return {std::move(solid), {}, false, {}};
}

Operand take_operand(const BoolOptions& options, const std::string& name, Run& run, Json& facts,
                     Intake& intake) {
  Findings findings(name, "");
  Operand operand;
  intake.given.operands.push_back({page_name(name, findings.input_name())});
  (void)with_findings(run, findings, [&] {
    operand = read_operand(options, run, findings, intake);
    if (up_of(findings) == View::Up::z) intake.given.up = View::Up::z;
    return ExitCode::done;
  });
  intake.given.operands.back().solid_triangles = operand.solid.triangles.size();
  end_operand(operand, findings, run, facts);
  return operand;
}

std::string what_was_written(const Surface& surface) {
  if (surface.mesh.triangles.empty()) return "nothing is solid, no triangles";
  return fmt::format("{}, volume {:.6g}", number_of(surface.mesh.triangles.size(), "triangle"),
                     signed_volume(surface.mesh));
}

void print_result(const BoolOptions& options, const RepairReport& repair,
                  const std::string& written, Run& run, const std::string& shown = {}) {
  const double seconds = run.progress.seconds();
  run.progress.finish();
  show_held_warnings();
  print_summary(fmt::format("operands  {} of {}\n{}{}written   {}: {}, in {:.2f} s\n",
                            operation_name(options.command.operation),
                            number_of(options.command.inputs.size(), "solid"), gaps_summary(repair),
                            predicates_summary(repair), options.command.step.output, written,
                            seconds));
  print_summary(shown);
}

// Nothing is a solid, too, though no surface. The comment keeps an OBJ file from being empty.
void write_nothing(WriteOptions format, Run& run, const Findings& findings) {
  format.extras.comments.emplace_back("nothing is solid");
  write_soup({}, findings.output, format);
  run.report.set_output({{"path", findings.output}, {"format", format_name(*format.format)}});
  run.report.set_section("result",
                         {{"triangles", 0}, {"points", 0}, {"parts", 0}, {"volume", 0.0}});
}

std::string all_names(const std::vector<std::string>& inputs) {
  std::string names = inputs.front();
  for (std::size_t i = 1; i < inputs.size(); ++i) names += ", " + inputs[i];
  return names;
}

ExitCode write_tree_result(const Tree& tree, const BoolOptions& options, Run& run,
                           Findings& findings) {
  write_tree_stage(tree, run, findings);
  print_result(options, findings.repair, number_of(tree.nodes.size(), "node"), run);
  return ExitCode::done;
}

ExitCode write_mesh_result(const Surface& surface, const JoinedMeshes& operands,
                           const GivenMeshes& given, const WriteOptions& format,
                           const BoolOptions& options, Run& run, Findings& findings) {
  Attributes attributes;
  if (surface.mesh.triangles.empty()) {
    write_nothing(format, run, findings);
  } else {
    attributes =
        transfer_attributes_stage(operands.soup, operands.attributes, surface, run, findings);
    write_mesh_stage(surface, attributes, format, options.command.step, run, findings);
  }
  draw_picture_stage(options.command.step.picture, given.up, options.command.inputs,
                     {{given.soup, given.attributes}, {surface.mesh, attributes}}, run, findings);
  write_boolean_page_stage(options.command.step.html,
                           {given.operands,
                            {given.soup, given.attributes},
                            surface,
                            attributes,
                            options.command.inputs,
                            given.up,
                            format.extras.unit},
                           run, findings);
  if (!findings.withheld)
    print_result(options, findings.repair, what_was_written(surface), run, findings.shown);
  return verdict(run, findings);
}

ExitCode combine_files(BoolOptions options, Run& run) {
  const bool to_tree = is_tree_name(options.command.step.output);
  BooleanOptions combining = boolean_options(options.command, run);
  WriteOptions format;
  if (!to_tree) {
    format = mesh_format(options.command.step);
    combining.repair = certified_for(*format.format, combining.repair);
  }
  options.carries_attributes =
      !options.command.step.assets.drops_all() && format.format && holds_attributes(*format.format);
  options.output_has_unit = format.format && has_unit(*format.format);
  Json facts = Json::array();
  Operands operands;
  const std::optional<LengthUnit> units = options.command.step.assets.units;
  Intake intake{CommonUnit(units, options.output_has_unit ? std::nullopt : units),
                CommonOrigin(options.command.step.origin, format.format),
                {}};
  check_inputs(options.command.inputs);
  for (const std::string& name : options.command.inputs) {
    Operand operand = take_operand(options, name, run, facts, intake);
    if (options.carries_attributes) {
      operand.attributes =
          chosen_for(*format.format, options.command.step.assets, std::move(operand.attributes));
    }
    operands.add(std::move(operand));
  }
  run.report.set_section("operands", std::move(facts));
  format.extras.unit = intake.unit.get();
  operands.join();
  keep_attributes(operands.joined.soup, operands.joined.attributes, combining.repair);
  Findings findings(all_names(options.command.inputs), options.command.step.output);
  findings.origin = intake.origin.get();
  return with_findings(run, findings, [&] {
    if (to_tree) {
      BooleanReport report;
      const Tree tree = boolean_tree(operands.solids, options.command.operation, combining, report);
      tell_of_boolean(options.command, report, run);
      return write_tree_result(tree, options, run, findings);
    }
    const Surface surface = combine(operands, options.command, combining, run, findings);
    return write_mesh_result(surface, operands.joined, intake.given, format, options, run,
                             findings);
  });
}

// What is asked of a mesh to write says nothing about a tree.
void refuse_mesh_options(const CommandLine& app) {
  for (const char* name : {"--format", "--drop", "--precision", "--strict", "--picture", "--html",
                           "--show", "--show-as", "--origin", "--restore-origin"}) {
    if (app.option(name).count() == 0) continue;
    throw UsageError(std::string(name) + " is for meshes, but the output is a tree (.bsp)");
  }
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  BoolOptions options;
  Program program("bspbool", "Unites, intersects and subtracts solids.",
                  "  bspbool body.stl hole.stl --op difference -o part.stl\n"
                  "  bspbool a.obj b.ply c.bsp --op union -o all.obj\n"
                  "  bspbool a.bsp b.bsp --op intersection -o both.bsp\n");
  CommandLine& app = program.command_line();
  app.add_option("IN", options.command.inputs,
                 "Two or more solids: trees (.bsp) and meshes; a mesh that is not a solid is\n"
                 "repaired first")
      ->check(names_file(mesh_and_tree_extensions()))
      ->required()
      ->repeated();
  add_output_option(app, options.command.step.output, "OUT", mesh_and_tree_extensions(),
                    "Mesh or, if it ends in .bsp, tree to write; - is standard output");
  add_boolean_command(app, options.command);
  add_origin_options(app, options.command.step.origin);
  add_picture_options(app, options.command.step.picture, "all IN and OUT side by side");
  add_show_options(app, options.command.step.picture, "all IN and OUT");
  add_html_options(app, options.command.step.html, "all IN and OUT, and what comes from which");
  return program.run(argc, argv, [&](Run& run) {
    if (options.command.step.output.empty()) throw UsageError("the name of the output is empty");
    if (options.command.inputs.size() < 2) throw UsageError("IN: at least two solids are needed");
    if (is_tree_name(options.command.step.output)) refuse_mesh_options(app);
    for (const std::string& input : options.command.inputs)
      check_files(input, options.command.step.output, run);
    std::vector<std::string> files = options.command.inputs;
    files.push_back(options.command.step.output);
    check_picture(options.command.step.picture, files, run);
    files.push_back(options.command.step.picture.path);
    check_html(options.command.step.html, files, run);
    return combine_files(options, run);
  });
}
