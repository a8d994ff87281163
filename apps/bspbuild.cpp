// SPDX-License-Identifier: MIT

#include "options/file_kinds.h"
#include "options/repair_options.h"
#include "program/program.h"
#include "report/findings.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"
#include "steps/step_options.h"

// bspbuild IN -o TREE: the first step of the repair, from mesh to tree.

namespace meshrepair {
namespace {

void build(const StepOptions& options, Run& run, Findings& findings) {
  const TriangleSoup soup = read_mesh_stage(read_options(run), run, findings).soup;
  const Tree tree = make_tree(soup, options.repair, findings.repair);
  write_tree_stage(tree, run, findings);
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  StepOptions options;
  Program program("bspbuild", "Partitions space along the triangles of a mesh.",
                  "  bspbuild broken.stl -o tree.bsp\n"
                  "  bspbuild broken.stl -o - | bspsolid - -o - | bspextract - -o repaired.obj\n");
  CommandLine& app = program.command_line();
  app.add_option("IN", options.input,
                 "Mesh to read: STL, OBJ, OFF, PLY, glTF or 3MF, optionally\n"
                 "compressed (.gz, .zst, .zip); - is standard input")
      ->check(names_file(mesh_extensions()))
      ->required();
  add_output_option(
      app, options.output, "FILE", kTreeExtension,
      "Tree to write (.bsp), without textures, normals, colours, materials and groups;\n"
      "- is standard output");
  add_sew_option(app, options.repair.sew);
  add_join_gaps_option(app, options.repair.join_gaps);
  add_holes_option(app, options.repair.holes);
  add_max_hole_option(app, options.repair.holes);
  return run_steps(program, argc, argv, options, build);
}
