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
      "Lists the defects of a mesh. Exit code 0: the mesh bounds a solid, 1: it does not.",
      "  meshcheck part.stl\n"
      "  meshcheck part.obj --mark defects.ply\n"
      "  meshcheck part.obj --json | jq .check.defects.open_edges.count\n");
  CommandLine& app = program.command_line();
  app.add_option("IN", command.input,
                 "Mesh to check: STL, OBJ, OFF, PLY, glTF or 3MF, optionally\n"
                 "compressed (.gz, .zst, .zip); - is standard input")
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
