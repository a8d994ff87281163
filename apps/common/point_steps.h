// Point clouds as input: their options, and the steps from their file to the soup that is repaired.
#pragma once

#include <vector>

#include <CLI/App.hpp>

#include <mesh/point_cloud.h>
#include <mesh/soup.h>
#include <points/scan_base.h>

#include "common/repair_steps.h"

namespace meshrepair {

// The options of the local triangulation.
void add_point_options(CLI::App& app, PointSoupOptions& options);

// Stage "read". What the reader passed over is logged as warnings.
[[nodiscard]] PointCloud read_points_stage(Run& run, Findings& findings);

// Stage "points": the local triangulation.
[[nodiscard]] PointSoup triangulate_stage(const PointCloud& cloud, PointSoupOptions options,
                                          Run& run, Findings& findings);

// How a program that repairs takes points.
struct PointOptions {
  bool as_points = false;  // a mesh, too
  bool base = false;       // close an open scan from below
  PointSoupOptions soup;
  ScanBaseOptions scan_base;
};

// --points, --base, --up and the options of the local triangulation.
void add_point_repair_options(CLI::App& app, PointOptions& options);

// What is to be repaired.
struct AnySoup {
  TriangleSoup soup;
  std::vector<float> opacity;  // as RepairOptions takes it
  Attributes attributes;       // of a mesh, if they are asked for
  Scene scene;                 // the same
};

// Reads a mesh as `reading` says, or a point cloud, triangulates it and puts it on its base.
[[nodiscard]] AnySoup read_any_stage(const PointOptions& options, const ReadOptions& reading,
                                     Run& run, Findings& findings);

// repair(), as the input needs it: the floor of a base is a hole of any size, and solids that the
// points are too few to tell are dropped. Throws NoSolidError, with advice, also where the points
// are those of an open scan, of which what can be enclosed would be mostly made up.
[[nodiscard]] Surface repair_any(const AnySoup& input, const PointOptions& points,
                                 const RepairOptions& options, Findings& findings);

}  // namespace meshrepair
