// meshconvert IN OUT: a mesh in another format, as it is.
#include <utility>

#include <spdlog/spdlog.h>

#include "common/attribute_report.h"
#include "common/repair_options.h"
#include "common/repair_steps.h"

namespace meshrepair {
namespace {

// Reads attributes also where the output holds none, to say what is lost.
void convert(const StepOptions& options, Run& run, Findings& findings) {
  WriteOptions format = mesh_format(options);
  Attributes all;
  const TriangleSoup soup =
      read_mesh_stage(run, findings, false, options.attributes ? &all : nullptr);
  run.report.set_section("attributes", attributes_section(soup, all));
  const Attributes held = held_by(*format.format, all);
  const std::string lost = lost_attributes(all, held);
  if (!lost.empty()) {
    spdlog::warn("{}: {} cannot hold what {} has: {}", findings.output_name(),
                 format_name(*format.format), findings.input_name(), lost);
  }
  format.extras.attributes = held.empty() ? nullptr : &held;
  write_soup_stage(soup, format, run, findings);
}

int run_program(int argc, char** argv) {
  StepOptions options;
  Program program("meshconvert", "Writes a mesh in another format, as it is: nothing is repaired.",
                  "  meshconvert part.obj part.glb\n"
                  "  meshconvert --attributes drop part.obj plain.stl\n"
                  "  meshconvert - part.off < part.stl\n");
  CLI::App& app = program.command_line();
  app.add_option("IN", options.input,
                 "Mesh to read: STL, OBJ, OFF, PLY, glTF or 3MF, maybe packed (.gz, .zst, .zip);\n"
                 "- is standard input")
      ->required();
  app.add_option("OUT", options.output, "Mesh to write, may be IN; - is standard output")
      ->required();
  add_format_option(app, options.format);
  add_attributes_option(app, options.attributes);
  return run_steps(program, argc, argv, options, convert);
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) { return meshrepair::run_program(argc, argv); }
