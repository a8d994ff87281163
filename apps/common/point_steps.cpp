#include "common/point_steps.h"

#include <utility>

#include <CLI/Validators.hpp>

namespace meshrepair {
namespace {

PointCloud keep(PointReadResult result, Findings& findings) {
  findings.points_read = std::move(result.report);
  log_warnings(findings.input_name(), findings.points_read->warnings);
  return std::move(result.cloud);
}

}  // namespace

void add_point_options(CLI::App& app, PointSoupOptions& options) {
  app.add_option("--votes", options.votes,
                 "Take triangles that so many of their corners want: 1, 2 or 3")
      ->check(CLI::Range(1, 3))
      ->type_name("N")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--reach", options.reach,
                 "Span gaps up to this radius, in spacings of the points around")
      ->check(CLI::Range(0.1, 1000.0))
      ->type_name("X")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--neighbours", options.neighbours, "Points that a tangent plane is fitted to")
      ->check(CLI::Range(5, 1000))
      ->type_name("N")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--outliers", options.outlier,
                 "Drop points whose spacing is so many times that of their neighbours; 0: none")
      ->check(CLI::NonNegativeNumber)
      ->type_name("X")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--project", options.project,
                 "Move noisy points so many times onto the surface that their neighbours suggest")
      ->check(CLI::Range(0, 100))
      ->type_name("N")
      ->capture_default_str()
      ->group("Points");
  app.add_flag("!--no-normals", options.use_normals, "Do not use the normals of the points")
      ->group("Points");
}

PointCloud read_points_stage(Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("read");
  PointReadOptions options;
  options.progress = &run.progress;
  return keep(read_points(findings.input, options), findings);
}

TriangleSoup triangulate_stage(const PointCloud& cloud, PointSoupOptions options, Run& run,
                               Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("points");
  options.progress = &run.progress;
  return make_point_soup(cloud, options, findings.point_soup.emplace()).soup;
}

TriangleSoup read_any_stage(bool as_points, const PointSoupOptions& options, Run& run,
                            Findings& findings) {
  PointCloud cloud;
  if (as_points) {
    cloud = read_points_stage(run, findings);
  } else {
    StageMeter meter(findings.repair.stages, &run.progress);
    meter.begin("read");
    MeshOrPoints input = read_mesh_or_points(findings.input, read_options(run));
    if (input.mesh) {
      findings.mesh_read = std::move(input.mesh->report);
      log_warnings(findings.input_name(), findings.mesh_read->warnings);
      return std::move(input.mesh->soup);
    }
    cloud = keep(std::move(*input.points), findings);
  }
  return triangulate_stage(cloud, options, run, findings);
}

}  // namespace meshrepair
