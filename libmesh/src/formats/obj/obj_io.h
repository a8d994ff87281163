// SPDX-License-Identifier: MIT
// Wavefront OBJ: meshes and points; everything else is ignored.
#pragma once

#include <filesystem>
#include <string>
#include <unordered_set>
#include <vector>

#include <mesh/mesh_source.h>
#include <mesh/point_reading.h>
#include <mesh/reading.h>
#include <mesh/soup_extras.h>

#include "formats/common/bundled_file.h"

namespace meshrepair {

// `v` gives a point: the first three numbers (w and colours are ignored); a point whose coordinates
// are not numbers, or fewer than three, is kept as NaN and counted as bad, so that the numbers of
// the others hold. `f` gives a face of any number of corners, `i`, `i/t`, `i/t/n` or `i//n`,
// counted from 1, or from the last point if negative; points may come after the faces that use
// them. Lines may be continued by a backslash. Of the files named inside
// only libraries of materials are opened, if attributes are asked for.
[[nodiscard]] ReadResult read_obj(const MeshSource& source);

// The text alone, which names no libraries of materials but those that could not be read.
[[nodiscard]] std::string format_obj(const TriangleSoup& soup, const SoupExtras& extras);

// What a mesh at `path` needs: pictures that are no files yet, a library of materials, and, last,
// the mesh.
[[nodiscard]] std::vector<BundledFile> obj_files(const TriangleSoup& soup, const SoupExtras& extras,
                                                 const std::filesystem::path& path);

// Names of the materials that libraries say all of, for an OBJ file.
[[nodiscard]] std::unordered_set<std::string> library_materials(const Attributes& attributes);

// The points alone: `v` gives a point, and its colour where six numbers or more follow, from 0 to
// 1; `vn` a normal. Normals belong to the points in order, and are none of theirs where there are
// not as many.
[[nodiscard]] PointReadResult read_obj_points(const MeshSource& source,
                                              const PointReadOptions& options);

}  // namespace meshrepair
