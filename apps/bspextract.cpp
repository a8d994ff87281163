// SPDX-License-Identifier: MIT

#include "options/file_kinds.h"
#include "options/repair_options.h"
#include "program/program.h"
#include "report/findings.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"
#include "steps/step_options.h"

// bspextract TREE -o OUT: the last step of the repair, from labelled tree to mesh.

namespace meshrepair {
namespace {

void extract(const StepOptions& options, Run& run, Findings& findings) {
  const WriteOptions format = mesh_format(options);
  const Tree tree = read_tree_stage(run, findings);
  const Surface surface =
      extract_mesh(tree, certified_for(*format.format, options.repair), findings.repair);
  write_mesh_stage(surface, {}, format, options, run, findings);
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  StepOptions options;
  Program program("bspextract", "Extracts the boundary of the solid cells of a labelled tree.",
                  "  bspextract solid.bsp -o repaired.obj\n"
                  "  bspextract solid.bsp -o - --format stl > repaired.stl\n");
  CommandLine& app = program.command_line();
  app.add_option("TREE", options.input, "Labelled tree from bspsolid; - is standard input")
      ->check(names_file(kTreeExtension))
      ->required();
  add_output_option(app, options.output, "OUT", mesh_extensions(),
                    "Mesh to write; - is standard output");
  add_touching_option(app, options.repair.extract.touching);
  add_simplify_option(app, options.repair.simplify);
  add_predicates_options(app, options.repair);
  add_format_option(app, options.format);
  add_sources_option(app, options.sources);
  add_certify_options(app, options.repair.certify, options.strict);
  return run_steps(program, argc, argv, options, extract);
}
