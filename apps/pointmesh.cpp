// SPDX-License-Identifier: MIT
// pointmesh POINTS -o SOUP: the local triangulation of a point cloud, for a repair to make a solid
// of.
#include "options/file_kinds.h"
#include "options/repair_options.h"
#include "steps/mesh_steps.h"
#include "steps/origin_steps.h"
#include "steps/point_steps.h"
#include "steps/run_steps.h"
#include "steps/step_options.h"

namespace meshrepair {
namespace {

int run_program(int argc, char** argv) {
  StepOptions options;
  PointSoupOptions points;
  Program program("pointmesh", "Triangulates a point cloud, each point with its neighbours.",
                  "  pointmesh scan.xyz -o soup.ply\n"
                  "  pointmesh scan.pcd -o - --format ply | meshrepair - solid.obj\n");
  CommandLine& app = program.command_line();
  app.add_option("POINTS", options.input,
                 "Points to read: XYZ, PTS, PWN, PCD, PLY, OBJ or OFF, optionally compressed\n"
                 "(.gz, .zst, .zip); - is standard input")
      ->check(names_file(point_extensions()))
      ->required();
  add_output_option(app, options.output, "FILE", mesh_extensions(),
                    "Triangles to write: with holes, and not oriented; - is standard output");
  add_point_options(app, points);
  add_format_option(app, options.format);
  add_origin_options(app, options.origin);
  return run_steps(
      program, argc, argv, options, [&](const StepOptions& steps, Run& run, Findings& findings) {
        const WriteOptions format = mesh_format(steps);
        AnySoup input;
        input.cloud = read_points_stage(run, findings);
        move_origin_stage(steps.origin, *format.format, Precision::float64, input, findings);
        const PointSoup result = triangulate_stage(*input.cloud, points, run, findings);
        write_soup_stage(result.soup, format, run, findings);
      });
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) { return meshrepair::run_program(argc, argv); }
