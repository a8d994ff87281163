// bspbuild IN -o TREE: the first step of the repair, from mesh to tree.
#include <string>

#include "common/repair_options.h"
#include "common/repair_steps.h"
#include "common/summary.h"

namespace meshrepair {
namespace {

struct Options {
  std::string input;
  std::string output;
  RepairOptions repair;
};

ExitCode build(Options& options, Run& run) {
  check_files(options.input, options.output, run);
  options.repair.progress = &run.progress;
  Findings findings(options.input, options.output);
  return with_findings(run, findings, [&] {
    const TriangleSoup soup = read_mesh_stage(run, findings);
    const Tree tree = make_tree(soup, options.repair, findings.repair);
    write_tree_stage(tree, run, findings);
    print_summary(run, findings);
    return ExitCode::done;
  });
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  Options options;
  Program program("bspbuild", "Partitions space along the triangles of a mesh.",
                  "  bspbuild broken.stl -o tree.bsp\n"
                  "  bspbuild broken.stl -o - | bspsolid - -o - | bspextract - -o repaired.obj\n");
  CLI::App& app = program.command_line();
  app.add_option("IN", options.input, "Mesh to read: STL, OBJ, OFF or PLY; - is standard input")
      ->required();
  app.add_option("-o,--output", options.output, "Tree to write (.bsp); - is standard output")
      ->required()
      ->type_name("FILE")
      ->group("Output");
  return program.run(argc, argv, [&](Run& run) { return build(options, run); });
}
