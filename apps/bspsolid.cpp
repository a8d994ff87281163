// bspsolid TREE -o TREE: the second step of the repair, which decides what is solid.
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

ExitCode label(Options& options, Run& run) {
  check_files(options.input, options.output, run);
  options.repair.progress = &run.progress;
  Findings findings(options.input, options.output);
  return with_findings(run, findings, [&] {
    Tree tree = read_tree_stage(run, findings);
    label_tree(tree, options.repair, findings.repair);
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
  Program program("bspsolid", "Decides which parts of a partitioned space are solid.",
                  "  bspsolid tree.bsp -o solid.bsp\n"
                  "  bspsolid tree.bsp -o solid.bsp --inside winding\n");
  CLI::App& app = program.command_line();
  app.add_option("TREE", options.input,
                 "Tree of bspbuild; the labels that it may have are replaced; - is standard input")
      ->required();
  app.add_option("-o,--output", options.output,
                 "Labelled tree to write (.bsp), may be TREE; - is standard output")
      ->required()
      ->type_name("FILE")
      ->group("Output");
  add_inside_option(app, options.repair.inside.rule);
  add_check_cells_option(app, options.repair.check_cells);
  return program.run(argc, argv, [&](Run& run) { return label(options, run); });
}
