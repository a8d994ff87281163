// SPDX-License-Identifier: MIT
// The triangles that the points of a cloud want, each for itself.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <mesh/soup.h>
#include <points/point_soup.h>

#include "sift_points.h"
#include "tangent_plane.h"

namespace meshrepair {

// The triangles around one point of a cloud: the Delaunay star in its tangent plane.
//
// The Voronoi cell of the point p in space, cut with the tangent plane at p, is a convex polygon:
// its sides are where the plane meets the bisectors of p and its neighbours. Two sides that meet in
// a corner belong to two neighbours that make a triangle with p, a facet of the Delaunay
// triangulation of the cloud in space. So the stars of different points, whose planes are slightly
// different, agree but for the flattest tetrahedra, their triangles do not cross each other, and a
// neighbour on the far side of a thin plate does not come in between: its bisector runs between
// the two sides, not across the plane.
//
// Points on one circle are common, in grids, and would be triangulated as rounding falls. Therefore
// each point has a weight, tiny against its squared spacing, as in a regular triangulation: all
// stars see the same weights, and settle such cases alike.
class TangentStar {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  // A corner of the polygon, relative to the point and in axes of the plane, and the neighbour
  // whose bisector is the side that begins there (counter-clockwise); kNone: the limit.
  struct Corner {
    double x = 0, y = 0;
    std::uint32_t neighbour = kNone;

    [[nodiscard]] double squared_radius() const { return x * x + y * y; }
  };

  // Begins with a square around a circle of the radius `limit`, in the plane through `at`.
  void begin(const Vec3d& at, const Vec3d& normal, double limit);

  // Takes a neighbour, in any order. `excess` is its weight minus that of the point.
  void add(std::uint32_t neighbour, const Vec3d& position, double excess);

  // Counter-clockwise, seen from where the normal points to.
  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }
  // Of the farthest corner. Neighbours twice as far, and a little for weights, change nothing.
  [[nodiscard]] double squared_radius() const;

 private:
  Vec3d at_ = Vec3d::Zero();
  Vec3d axis_x_ = Vec3d::UnitX();
  Vec3d axis_y_ = Vec3d::UnitY();
  std::vector<Corner> corners_;
  std::vector<Corner> clipped_;
  std::vector<double> side_;
};

struct StarTriangle {
  std::array<std::uint32_t, 3> corners;  // ascending
  // 1: (corners[0], corners[1], corners[2]) is counter-clockwise seen from where the point's normal
  // points to, -1: clockwise, 0: the point does not know which side is out.
  std::int8_t turn = 0;
};

// The tangent planes, given or fitted. Throws Cancelled.
[[nodiscard]] std::vector<TangentPlane> find_tangent_planes(const SiftedCloud& cloud,
                                                            const PointSoupOptions& options);

// The triangles of all stars, those that several points want as often. Throws Cancelled.
[[nodiscard]] std::vector<StarTriangle> build_stars(const SiftedCloud& cloud,
                                                    const std::vector<TangentPlane>& planes,
                                                    const PointSoupOptions& options);

}  // namespace meshrepair
