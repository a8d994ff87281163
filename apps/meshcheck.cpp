// SPDX-License-Identifier: MIT
// meshcheck IN: what is wrong with a mesh, and whether it is the boundary of a solid.
#include "options/file_kinds.h"
#include "steps/check_command.h"

int main(int argc, char** argv) {
  using namespace meshrepair;
  CheckCommand command;
  bool json = false;
  Program program(
      "meshcheck",
      "Says what is wrong with a mesh. Exit code 0: it is the boundary of a solid, 1: it "
      "is not.",
      "  meshcheck part.stl\n"
      "  meshcheck part.obj --mark defects.ply\n"
      "  meshcheck part.obj --json | jq .check.defects.open_edges.count\n");
  CommandLine& app = program.command_line();
  app.add_option("IN", command.input,
                 "Mesh to check: STL, OBJ, OFF, PLY, glTF or 3MF, maybe packed (.gz, .zst, .zip);\n"
                 "- is standard input")
      ->check(names_file(mesh_extensions()))
      ->required();
  add_check_command(app, command);
  app.add_flag("--json", json, "Print the report instead of the table: --report -")
      ->group("Output");
  return program.run(argc, argv, [&](Run& run) {
    if (json) program.report_to_standard_output();
    return check_file(command, run);
  });
}
