// Point clouds as input: their options, and the steps from their file to the soup that is repaired.
#pragma once

#include <CLI/App.hpp>

#include <bsp/point_cloud.h>
#include <bsp/soup.h>

#include "common/repair_steps.h"

namespace meshrepair {

// The options of the local triangulation.
void add_point_options(CLI::App& app, PointSoupOptions& options);

// Stage "read". What the reader passed over is logged as warnings.
[[nodiscard]] PointCloud read_points_stage(Run& run, Findings& findings);

// Stage "points": the local triangulation.
[[nodiscard]] TriangleSoup triangulate_stage(const PointCloud& cloud, PointSoupOptions options,
                                             Run& run, Findings& findings);

// Reads a mesh, or a point cloud and triangulates it; `as_points` takes a mesh for its points, too.
[[nodiscard]] TriangleSoup read_any_stage(bool as_points, const PointSoupOptions& options, Run& run,
                                          Findings& findings);

}  // namespace meshrepair
