// SPDX-License-Identifier: MIT
// What readers of point clouds are asked, and what they return.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <base/progress.h>
#include <base/warning.h>
#include <mesh/packing.h>
#include <mesh/point_cloud.h>

namespace meshrepair {

enum class PointFormat {
  xyz,
  pts,
  pcd_ascii,
  pcd_binary,
  pcd_compressed,
  ply_ascii,
  ply_binary,
  obj,
  off,
  stl
};

struct PointReadReport {
  PointFormat format = PointFormat::xyz;
  std::size_t bytes = 0;  // unpacked
  PackedFile packed;
  std::optional<Vec3d> offset = std::nullopt;  // as of ReadReport
  std::uint64_t declared_points = 0;           // by the header; 0 if it has none
  std::size_t bad_points = 0;                  // left out: not numbers, or too few
  std::uint64_t missing_points = 0;            // promised by the header, not in the file
  std::size_t trailing_bytes = 0;              // after the last point of a binary file
  bool normals = false;                        // the file has some, asked for or not
  bool colours = false;
  // One sentence for each kind of oddity, for the user, without the file's name.
  std::vector<Warning> warnings;
};

struct PointReadResult {
  PointCloud cloud;
  PointReadReport report;
};

struct PointReadOptions {
  bool normals = true;   // keep them, where there are any
  bool colours = false;  // the same
  ProgressObserver* progress = nullptr;
};

}  // namespace meshrepair
