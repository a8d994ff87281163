// SPDX-License-Identifier: MIT
// meshconvert IN OUT: a mesh in another format, as it is.
#include <utility>

#include "options/file_kinds.h"
#include "options/repair_options.h"
#include "pictures/picture_steps.h"
#include "program/program.h"
#include "report/attribute_report.h"
#include "report/findings.h"
#include "steps/mesh_steps.h"
#include "steps/origin_steps.h"
#include "steps/run_steps.h"
#include "steps/scene_steps.h"
#include "steps/step_options.h"

namespace meshrepair {
namespace {

// A slicer's project keeps all its volumes in 3MF, unless joining them was asked for: it is read
// again then. Attributes are read also where the output holds none, to say what is lost.
ReadResult read_input(SoupFormat output, StepOptions& options, Run& run, Findings& findings) {
  ReadOptions reading = read_options(run);
  reading.attributes = !options.assets.drops_all();
  reading.by_mesh = options.assets.by_mesh;
  reading.beam_sides = options.assets.beam_sides;
  if (output != SoupFormat::threemf || options.assets.scene_chosen || options.input == "-") {
    return read_mesh_stage(reading, run, findings);
  }
  reading.may_be_empty = true;  // of a model
  ReadResult input = read_soup(options.input, reading);
  reading.may_be_empty = false;
  if (!input.report.volumes.empty()) reading.by_mesh = options.assets.by_mesh = true;
  if (reading.by_mesh || input.soup.triangles.empty()) {
    return read_mesh_stage(reading, run, findings);
  }
  keep_read_report(input.report, findings);
  return input;
}

void convert(StepOptions options, Run& run, Findings& findings) {
  WriteOptions format = mesh_format(options);
  ReadResult read = read_input(*format.format, options, run, findings);
  AnySoup input;
  input.soup = std::move(read.soup);
  input.attributes = std::move(read.attributes);
  input.scene = std::move(read.scene);
  move_origin_stage(options.origin, *format.format, Precision::float64, input, findings);
  const TriangleSoup& soup = input.soup;
  const Attributes& all = input.attributes;
  check_picture(options.picture, all);
  run.report.set_section("attributes", attributes_section(soup, all));
  const Attributes held = chosen_for(*format.format, options.assets, all);
  const Attributes still_held = held_by(*format.format, all, options.assets.by_mesh);
  warn_of_lost(soup, all, still_held, *format.format, findings);
  format.extras.attributes = held.empty() ? nullptr : &held;
  if (options.assets.by_mesh) {
    check_scene(input.scene, *format.format);
    format.extras.scene = &input.scene;
  }
  if (findings.origin)
    *findings.origin *= scale_to_unit(*format.format, options.assets, findings.unit);
  findings.unit = brought_to_unit(*format.format, options.assets, findings.unit, input.soup);
  format.extras.unit = findings.unit;
  write_soup_stage(soup, format, run, findings);
  draw_picture_stage(options.picture, up_of(findings), {options.input}, {{soup, all}, {soup, held}},
                     run, findings);
}

int run_program(int argc, char** argv) {
  StepOptions options;
  Program program("meshconvert", "Converts a mesh to another format without repairing it.",
                  "  meshconvert part.obj part.glb\n"
                  "  meshconvert --drop all part.obj plain.stl\n"
                  "  meshconvert - part.off < part.stl\n");
  CommandLine& app = program.command_line();
  app.add_option("IN", options.input,
                 "Mesh to read: STL, OBJ, OFF, PLY, glTF or 3MF, optionally\n"
                 "compressed (.gz, .zst, .zip); - is standard input")
      ->check(names_file(mesh_extensions()))
      ->required();
  app.add_option("OUT", options.output, "Mesh to write, may be IN; - is standard output")
      ->check(names_file(mesh_extensions()))
      ->required();
  add_format_option(app, options.format);
  add_drop_option(app, options.assets);
  add_scene_option(app, options.assets, "Output");
  add_beam_sides_option(app, options.assets);
  add_units_option(app, options.assets);
  add_origin_options(app, options.origin);
  add_picture_options(app, options.picture, "IN and OUT side by side");
  add_show_options(app, options.picture, "IN and OUT");
  return run_steps(program, argc, argv, options, convert);
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) { return meshrepair::run_program(argc, argv); }
