// SPDX-License-Identifier: MIT
// Reading of point clouds: XYZ, PTS, PWN, PCD, and the points of PLY, OBJ, OFF and STL.
//
// As with meshes (soup_io.h), the content tells the format first, then the extension; the bytes
// decide, never a declared count, and no memory is taken for what the file cannot hold. What cannot
// be read as a point is left out and counted; coordinates that are "nan" or infinite are kept.
//
// XYZ (.xyz, .xyzn, .txt, .asc, .csv) is text: a point on each line, x y z and maybe more, parted
// by blanks, commas or semicolons; # and // begin comments. Of what follows, three numbers of
// length 1 are a normal, three integers from 0 to 255 a colour. PTS begins with the number of
// points, and may have an intensity before the colour. PWN has six numbers on each line, or the
// number of points, all points, then all normals.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <mesh/point_reading.h>
#include <mesh/reading.h>

namespace meshrepair {

// "XYZ", "binary PCD", ...: for messages.
[[nodiscard]] std::string_view format_name(PointFormat format);

// ".xyz, .pts, ..., .pcd": of files that hold nothing but points. Those of meshes may, too.
[[nodiscard]] std::string known_point_extensions();

// Reads a file; "-" is standard input. Of meshes, takes the points. Throws InputError (one line
// that names the file and the place) when it cannot be opened, is empty, holds no format that is
// known, or no readable point at all; Cancelled.
[[nodiscard]] PointReadResult read_points(const std::filesystem::path& path,
                                          const PointReadOptions& options = {});
// The same from memory. `name` is used in messages and for its extension.
[[nodiscard]] PointReadResult read_points(std::string_view bytes, const std::string& name,
                                          const PointReadOptions& options = {});

// One of the two.
struct MeshOrPoints {
  std::optional<ReadResult> mesh;
  std::optional<PointReadResult> points;
};

// Reads a mesh as read_soup() does; but what is a point cloud by its format, or has points and
// neither has nor promises faces, is read as one. Throws as both do.
[[nodiscard]] MeshOrPoints read_mesh_or_points(const std::filesystem::path& path,
                                               const ReadOptions& options = {});
[[nodiscard]] MeshOrPoints read_mesh_or_points(std::string_view bytes, const std::string& name,
                                               const ReadOptions& options = {});

}  // namespace meshrepair
