// SPDX-License-Identifier: MIT
// Convex pieces of walls, and the convex hulls that they are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <base/vec3.h>
#include <repair/thicken_sheets.h>

#include "sheet_mesh.h"

namespace meshrepair::internal {

// Triangles of indices into `points`, counter-clockwise seen from outside; none where all points
// lie in one plane. Exact. Takes the number of points times that of triangles.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Vec3d> points);

// Adds the hull of the points to the walls, each of its triangles with the source of that one of
// `beside`, triangles of the mesh, which it is most nearly parallel to. Nothing where the points
// lie in one plane.
void append_hull(const SheetMesh& mesh, std::span<const Vec3d> points,
                 std::span<const std::uint32_t> beside, SheetWalls& walls);

// From one place of a sheet to another, by half of what its wall reaches from it, or half of the
// way.
[[nodiscard]] Vec3d on_the_way(const Vec3d& from, const Vec3d& to, double reach);

// Adds the points p + reach v, v on the way from `from` over `over` to `to`, all about 1 long, the
// ends left out: so many that the chords between them are within kMostBeside of the arc.
void append_arc(const Vec3d& p, double reach, const Vec3d& from, const Vec3d& over, const Vec3d& to,
                std::vector<Vec3d>& points);

}  // namespace meshrepair::internal
