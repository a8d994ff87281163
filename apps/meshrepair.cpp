// SPDX-License-Identifier: MIT
// meshrepair IN OUT: any triangle mesh or point cloud to the boundary of a solid, the whole way in
// one process.
#include <string>

#include <base/error.h>

#include "options/file_kinds.h"
#include "resume/resumable.h"
#include "serve/serve.h"
#include "steps/repair_command.h"
#include "steps/run_steps.h"

int main(int argc, char** argv) {
  using namespace meshrepair;
  if (asks_to_serve(argc, argv)) return serve(argc, argv);
  RepairCommand command;
  Program program(
      "meshrepair", "Turns any triangle mesh or point cloud into the boundary of a solid.",
      "  meshrepair broken.stl repaired.stl\n"
      "  meshrepair --for print broken.obj part.stl\n"
      "  meshrepair --inside solidity --report report.json broken.obj repaired.ply\n"
      "  meshrepair scan.xyz solid.obj\n"
      "  meshrepair --resume broken.states --max-memory 8G broken.obj repaired.ply\n"
      "  curl https://example.org/mesh.stl | meshrepair --format stl - - > repaired.stl\n");
  CommandLine& app = program.command_line();
  app.add_option("IN", command.steps.input,
                 "Mesh to repair: STL, OBJ, OFF, PLY, glTF or 3MF; or points: XYZ, PTS, PWN, PCD,\n"
                 "PLY, OBJ or OFF without faces; optionally compressed (.gz, .zst, .zip);\n"
                 "- is standard input")
      ->check(names_file(mesh_and_point_extensions()))
      ->required();
  app.add_option("OUT", command.steps.output, "Mesh to write, may be IN; - is standard output")
      ->check(names_file(mesh_extensions()))
      ->required();
  add_repair_command(app, command);
  std::string resume;
  add_resume_option(app, resume);
  app.add_flag_callback(
         "--serve",
         [] { throw UsageError("--serve: must be the first argument, without IN and OUT"); },
         "Serve a local web page that checks and repairs meshes; takes no IN and OUT:\n"
         "see --serve --help")
      ->group("Page");
  return run_steps(program, argc, argv, command.steps,
                   [&](const StepOptions&, Run& run, Findings& findings) {
                     run_resumable(resume, app, run, [&](StateStore* states) {
                       command.steps.repair.states = states;
                       repair_file(command, run, findings);
                     });
                   });
}
