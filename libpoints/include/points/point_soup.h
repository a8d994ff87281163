// SPDX-License-Identifier: MIT
// From a point cloud to a triangle soup: the local triangulation that a repair then makes a solid
// of (WM 6.3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <mesh/point_cloud.h>
#include <mesh/soup.h>

namespace meshrepair {

// Lengths are in spacings: the square root of the area that a point has to itself around there.
struct PointSoupOptions {
  // A triangle needs as many of its corners to want it, 1 to 3. One is the most generous.
  int votes = 1;
  // Whether of triangles that lie on each other, because points disagree, only those are taken that
  // more points want.
  bool agree = true;
  // Open pieces of fewer triangles are dropped.
  std::size_t fewest_triangles = 20;
  // Points around one that its tangent plane is fitted to.
  std::size_t neighbours = 16;
  // The largest radius of a circle around a triangle, without another point on that sheet: holes
  // that are wider stay open.
  double reach = 3;
  // Points nearer to another one than this are duplicates.
  double duplicate = 0.01;
  // Points whose spacing is so many times that of their neighbours are outliers, and so are those
  // of small open pieces whose triangles are so much larger than others; 0: none are.
  double outlier = 5;
  // How often each point is moved onto the surface that its neighbours suggest, twice as many as
  // above; points that are too near to others then are dropped.
  int project = 0;
  // Whether normals of the cloud are taken, or planes fitted all the same.
  bool use_normals = true;
  std::size_t most_triangles = 0;  // more are a LimitError; 0: any number
  ProgressObserver* progress = nullptr;
};

// Filled as far as the work came, also when it ended with an exception. Lengths are in the units of
// the cloud.
struct PointSoupReport {
  std::size_t points_in = 0;
  std::size_t not_finite = 0;  // dropped
  std::size_t duplicates = 0;  // dropped
  std::size_t outliers = 0;    // dropped
  std::size_t points = 0;      // left
  bool normals_used = false;   // those of the cloud
  double spacing = 0;          // the median
  double smallest_spacing = 0;
  double largest_spacing = 0;
  std::size_t thinned = 0;                   // dropped after projection, too near to others
  double farthest_move = 0;                  // of a point by projection
  std::array<std::size_t, 3> by_votes = {};  // triangles that 1, 2, 3 corners want
  std::size_t disagreed = 0;                 // of those with votes enough, dropped
  std::size_t loose = 0;                     // that only touched others in a point, dropped
  std::size_t crumbs = 0;                    // in pieces that are too small, dropped
  std::size_t triangles = 0;                 // left

  // Share of the triangles that all three corners want.
  [[nodiscard]] double agreement() const;
};

struct PointSoup {
  // The points that are left, in the order of the cloud: with the coordinates that they had, bit
  // for bit, unless they were projected.
  TriangleSoup soup;
  std::vector<std::uint8_t> votes;  // of each triangle

  // For RepairOptions::opacity: of each triangle the share of its corners that want it.
  [[nodiscard]] std::vector<float> opacity() const;
};

// The soup of all triangles of the Delaunay stars that the points have in their tangent planes (see
// tangent_star.h). It has holes where points are missing, and where points are nearly on one
// sphere, flat tetrahedra. Triangles turn as the normals say where there are any, else any way
// round. The same for any number of threads. Throws UsageError when the options make no sense,
// NoSolidError when fewer than four points or no triangles are left, LimitError, Cancelled.
[[nodiscard]] PointSoup make_point_soup(const PointCloud& cloud, const PointSoupOptions& options,
                                        PointSoupReport& report);

}  // namespace meshrepair
