// SPDX-License-Identifier: MIT
// A soup brought onto the working grid: the exact input of everything that follows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <base/ids.h>
#include <base/progress.h>
#include <exact/grid.h>
#include <exact/plane_table.h>
#include <mesh/soup.h>

namespace meshrepair {

// A triangle that is not degenerate on the grid and differs from every other one in its corners.
struct Triangle {
  // In the order of its first copy, or the other way round if that is how it counts.
  std::array<PointId, 3> corners;
  PlaneId plane;
  // How its copies are turned: +1 more along the plane's normal than against it, -1 fewer, 0 as
  // many. Those at the very same place, as given, count once for each way they are turned, but for
  // `layers`.
  std::int32_t winding = 0;
  // Index of the first copy in the soup that was given; kNoSource for one that closes a hole.
  std::uint32_t source = 0;
  static constexpr std::uint32_t kNoSource = ~std::uint32_t{0};
  // How many surfaces it is part of, all turned so: above 1 where closed surfaces that overlap have
  // it in common. A face that is merely listed several times is one.
  std::int32_t layers = 1;
};

struct CleanSoup {
  Grid grid;
  IdVector<PointId, Vec3d> points;           // original coordinates, one for each grid point in use
  IdVector<PointId, GridPoint> grid_points;  // all different
  IdVector<TriangleId, Triangle> triangles;  // those without a source come last
  PlaneTable planes;
};

// What clean_soup() dropped or joined.
struct CleanReport {
  std::size_t triangles_in = 0;
  std::size_t dropped_not_finite = 0;   // a corner is NaN or infinite
  std::size_t dropped_degenerate = 0;   // corners equal or in a line, as given
  std::size_t dropped_below_grid = 0;   // only on the grid: narrower than about one of its steps
  std::size_t duplicates = 0;           // copies with the same orientation as the first
  std::size_t opposite_duplicates = 0;  // copies turned the other way
  std::size_t joined_points = 0;        // points with different coordinates on one grid point
  double grid_unit = 0;                 // in the input's units; points moved by at most half of it
};

// Rounds the points to the grid, joins those that fall on one grid point, drops and counts what
// cannot be a triangle. The result may be without triangles. Linear time. Throws InputError when an
// index is out of range, LimitError beyond kMostTriangles, Cancelled when `progress` says so.
[[nodiscard]] CleanSoup clean_soup(const TriangleSoup& soup, CleanReport& report,
                                   ProgressObserver* progress = nullptr);

// The same of a surface that is closed, and turned rightly, as a result of extraction is: all
// copies of a triangle count, so that it stays closed but for triangles that become lines.
[[nodiscard]] CleanSoup clean_surface(const TriangleSoup& mesh, CleanReport& report,
                                      ProgressObserver* progress = nullptr);

// In the input's units.
[[nodiscard]] double area_of(const CleanSoup& soup, const Triangle& triangle);

// The smallest box that holds all points; a point at the origin when there are none.
[[nodiscard]] GridBox bounding_box(const CleanSoup& soup);

// The box that stands for all of space: the bounding box of the points with a margin on every side,
// so that every input point is strictly inside.
[[nodiscard]] GridBox outer_box(const CleanSoup& soup);

}  // namespace meshrepair
