// SPDX-License-Identifier: MIT
// Coordinates far from the origin, such as those of surveys (UTM: 500000 and 4649776), for programs
// and formats with single precision, whose numbers are half a unit apart there.
//
//   const Vec3d offset = fitting_offset(soup.points, typical_edge(soup));
//   move_points(soup.points, -offset);
//
// Files without a place for such an offset have it in a comment at their beginning:
// "# offset 500000 4649776 0" in OBJ, OFF and lists of points, "comment offset ..." in PLY. The
// offset plus the coordinates of the file are those that were meant.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <mesh/soup.h>

namespace meshrepair {

// What becomes of points that are written with single precision.
struct SinglePrecisionLoss {
  double step = 0;      // of numbers at the largest coordinate
  double move = 0;      // of a point at most
  double diagonal = 0;  // of the bounding box
  // The points move by more than a hundred-thousandth of the diagonal, or a hundredth of `spacing`.
  bool matters = false;
};

// `spacing`: of neighbouring points, or 0. Points that are not finite are left out. Linear.
[[nodiscard]] SinglePrecisionLoss single_precision_loss(std::span<const Vec3d> points,
                                                        double spacing);

// The median length of the shortest edges of some triangles, evenly chosen; 0 without triangles.
[[nodiscard]] double typical_edge(const TriangleSoup& soup);

// Round numbers near the middle of the points, as far as the points are farther from 0 than their
// bounding box is large; 0 in axes where they are not. Then the difference of a coordinate and the
// offset is exact, and so is their sum later. All 0 where single precision holds the points well.
[[nodiscard]] Vec3d fitting_offset(std::span<const Vec3d> points, double spacing);

void move_points(std::span<Vec3d> points, const Vec3d& by);

// "offset 500000 4649776 0", for a comment.
[[nodiscard]] std::string offset_comment(const Vec3d& offset);

// What a comment in the first lines of a file says.
[[nodiscard]] std::optional<Vec3d> find_offset_comment(std::string_view bytes);

}  // namespace meshrepair
