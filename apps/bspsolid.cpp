// SPDX-License-Identifier: MIT

#include "options/file_kinds.h"
#include "options/repair_options.h"
#include "program/program.h"
#include "report/findings.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"
#include "steps/step_options.h"

// bspsolid TREE -o TREE: the second step of the repair, which decides what is solid.

namespace meshrepair {
namespace {

void label(const StepOptions& options, Run& run, Findings& findings) {
  Tree tree = read_tree_stage(run, findings);
  label_tree(tree, options.repair, findings.repair);
  write_tree_stage(tree, run, findings);
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  StepOptions options;
  Program program("bspsolid", "Decides which cells of a tree are solid.",
                  "  bspsolid tree.bsp -o solid.bsp\n"
                  "  bspsolid tree.bsp -o solid.bsp --inside winding\n");
  CommandLine& app = program.command_line();
  app.add_option("TREE", options.input,
                 "Tree from bspbuild; existing labels are replaced; - is standard input")
      ->check(names_file(kTreeExtension))
      ->required();
  add_output_option(app, options.output, "FILE", kTreeExtension,
                    "Labelled tree to write (.bsp), may be TREE; - is standard output");
  add_inside_options(app, options.repair.inside);
  add_holes_option(app, options.repair.holes);
  add_predicates_options(app, options.repair);
  return run_steps(program, argc, argv, options, label);
}
