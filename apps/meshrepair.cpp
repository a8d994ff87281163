// SPDX-License-Identifier: MIT
// meshrepair IN OUT: any triangle mesh or point cloud to the boundary of a solid, the whole way in
// one process.
#include <string>

#include <base/error.h>

#include "jobs/work_off_jobs.h"
#include "options/file_kinds.h"
#include "resume/resumable.h"
#include "serve/serve.h"
#include "steps/repair_command.h"
#include "steps/run_steps.h"

namespace meshrepair {
namespace {

// Those that take the place of IN and OUT.
void add_other_ways(CommandLine& app) {
  app.add_flag_callback(
         "--serve",
         [] { throw UsageError("--serve: must be the first argument, without IN and OUT"); },
         "Serve a local web page that checks and repairs meshes; takes no IN and OUT:\n"
         "see --serve --help")
      ->group("Page");
  app.add_option_function(
         "--jobs-from",
         [](const std::string& /*file*/) {
           throw UsageError("--jobs-from: must be the first argument, without IN and OUT");
         },
         "Repair the many meshes that this file names, - is standard input; takes no IN and\n"
         "OUT: see --jobs-from --help")
      ->type_name("FILE")
      ->group("Running");
}

void add_options(CommandLine& app, RepairCommand& command, std::string& resume) {
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
  add_resume_option(app, resume);
  add_other_ways(app);
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  if (asks_to_serve(argc, argv)) return serve(argc, argv);
  RepairCommand command;
  std::string resume;
  Program program(
      "meshrepair", "Turns any triangle mesh or point cloud into the boundary of a solid.",
      "  meshrepair broken.stl repaired.stl\n"
      "  meshrepair --for print broken.obj part.stl\n"
      "  meshrepair --inside solidity --report report.json broken.obj repaired.ply\n"
      "  meshrepair scan.xyz solid.obj\n"
      "  meshrepair --resume broken.states --max-memory 8G broken.obj repaired.ply\n"
      "  curl https://example.org/mesh.stl | meshrepair --format stl - - > repaired.stl\n");
  CommandLine& app = program.command_line();
  add_options(app, command, resume);
  const auto repair = [&](int count, const char* const* words) {
    return run_steps(program, count, words, command.steps,
                     [&](const StepOptions&, Run& run, Findings& findings) {
                       run_resumable(resume, app, run, [&](StateStore* states) {
                         command.steps.repair.states = states;
                         repair_file(command, run, findings);
                       });
                     });
  };
  if (asks_for_jobs(argc, argv)) return work_off_jobs(argc, argv, program, repair);
  return repair(argc, argv);
}
