// bspextract TREE -o OUT: the last step of the repair, from labelled tree to mesh.
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

ExitCode extract(Options& options, Run& run) {
  check_files(options.input, options.output, run);
  const WriteOptions format = mesh_format(options.output, options.format);
  options.repair.progress = &run.progress;
  if (format.format == SoupFormat::stl_binary) {
    options.repair.certify.precision = Precision::float32;
  }
  Findings findings(options.input, options.output);
  return with_findings(run, findings, [&] {
    const Tree tree = read_tree_stage(run, findings);
    const Surface surface = extract_mesh(tree, options.repair, findings.repair);
    return write_certified(surface, format, options.strict, run, findings);
  });
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  Options options;
  Program program("bspextract", "Extracts the boundary of what is solid in a labelled tree.",
                  "  bspextract solid.bsp -o repaired.obj\n"
                  "  bspextract solid.bsp -o - --format stl > repaired.stl\n");
  CLI::App& app = program.command_line();
  app.add_option("TREE", options.input, "Labelled tree of bspsolid; - is standard input")
      ->required();
  app.add_option("-o,--output", options.output, "Mesh to write; - is standard output")
      ->required()
      ->type_name("OUT")
      ->group("Output");
  add_check_cells_option(app, options.repair.check_cells);
  add_format_option(app, options.format);
  add_certify_options(app, options.repair.certify, options.strict);
  return program.run(argc, argv, [&](Run& run) { return extract(options, run); });
}
