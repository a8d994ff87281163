// SPDX-License-Identifier: MIT
// Point clouds as input: their options, and the steps from their file to the soup that is repaired.
#pragma once

#include <optional>
#include <vector>

#include <mesh/model_volume.h>
#include <mesh/point_cloud.h>
#include <mesh/soup.h>
#include <repair/repair_points.h>

#include "options/command_line.h"
#include "program/program.h"
#include "report/findings.h"

namespace meshrepair {

// The options of the local triangulation.
void add_point_options(CommandLine& app, PointSoupOptions& options);

// Stage "read". What the reader passed over is logged as warnings.
[[nodiscard]] PointCloud read_points_stage(Run& run, Findings& findings);

// Stage "points": the local triangulation.
[[nodiscard]] PointSoup triangulate_stage(const PointCloud& cloud, PointSoupOptions options,
                                          Run& run, Findings& findings);

// How a program that repairs takes points.
struct PointOptions {
  bool as_points = false;      // a mesh, too
  RepairPointsOptions repair;  // but for its `repair`
};

// --points, --base, --up, --no-advice and the options of the local triangulation.
void add_point_repair_options(CommandLine& app, PointOptions& options);

// What is to be repaired.
struct AnySoup {
  TriangleSoup soup;                      // of points, once they are triangulated
  std::optional<PointCloud> cloud;        // it is one
  Attributes attributes;                  // of a mesh, if they are asked for
  Scene scene;                            // the same
  std::vector<PlacedVolume> placed = {};  // see ReadResult
};

// Reads a mesh as `reading` says, or a point cloud.
[[nodiscard]] AnySoup read_any_stage(const PointOptions& options, const ReadOptions& reading,
                                     Run& run, Findings& findings);

// repair() or repair_points(). Throws NoSolidError with advice where points enclose nothing.
[[nodiscard]] Surface repair_any(AnySoup& input, const PointOptions& points,
                                 const RepairOptions& options, Run& run, Findings& findings);

}  // namespace meshrepair
