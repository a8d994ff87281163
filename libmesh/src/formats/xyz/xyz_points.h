// Points as lines of numbers: XYZ, PTS and PWN. See point_io.h.
#pragma once

#include <mesh/mesh_source.h>
#include <mesh/point_reading.h>

namespace meshrepair {

// Whether the first line that is no comment has three numbers at least, or has one, a count, and
// the next has three.
[[nodiscard]] bool begins_with_points(std::string_view bytes);

// `.xyz` and the like, which tell such a file from an OFF without its first line.
[[nodiscard]] bool has_point_extension(const std::string& name);

// Lines that hold no point are left out and counted. Throws InputError when these are more than
// the points: the file is something else.
[[nodiscard]] PointReadResult read_xyz_points(const MeshSource& source,
                                              const PointReadOptions& options);

}  // namespace meshrepair
