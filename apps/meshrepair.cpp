// meshrepair IN OUT: any triangle mesh to the boundary of a solid, the whole way in one process.
#include <optional>
#include <string>

#include "common/repair_options.h"
#include "common/repair_steps.h"

namespace meshrepair {
namespace {

struct Options {
  std::string input;
  std::string output;
  std::optional<SoupFormat> format;
  bool strict = false;
  RepairOptions repair;
};

ExitCode repair_mesh(Options& options, Run& run) {
  check_files(options.input, options.output, run);
  const WriteOptions format = mesh_format(options.output, options.format);
  options.repair.progress = &run.progress;
  if (format.format == SoupFormat::stl_binary) {
    options.repair.certify.precision = Precision::float32;
  }
  Findings findings(options.input, options.output);
  return with_findings(run, findings, [&] {
    const TriangleSoup soup = read_mesh_stage(run, findings);
    const Surface surface = repair(soup, options.repair, findings.repair);
    return write_certified(surface, format, options.strict, run, findings);
  });
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  Options options;
  Program program(
      "meshrepair", "Turns any triangle mesh into the boundary of a solid.",
      "  meshrepair broken.stl repaired.stl\n"
      "  meshrepair --inside solidity --report report.json broken.obj repaired.ply\n"
      "  curl https://example.org/mesh.stl | meshrepair --format stl - - > repaired.stl\n");
  CLI::App& app = program.command_line();
  app.add_option("IN", options.input, "Mesh to repair: STL, OBJ, OFF or PLY; - is standard input")
      ->required();
  app.add_option("OUT", options.output, "Mesh to write, may be IN; - is standard output")
      ->required();
  add_inside_option(app, options.repair.inside.rule);
  add_check_cells_option(app, options.repair.check_cells);
  add_format_option(app, options.format);
  add_certify_options(app, options.repair.certify, options.strict);
  return program.run(argc, argv, [&](Run& run) { return repair_mesh(options, run); });
}
