// SPDX-License-Identifier: MIT
// Flat faces that are near each other come to lie in one plane.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <check/near_faces.h>
#include <mesh/edge_table.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Triangles that are near each other, or go on from each other across edges, are in one level as
// far as they are within the distance of the plane of the largest one that is near another.
class Levels {
 public:
  // `corners` are those of the soup, by the first points in their places.
  Levels(const TriangleSoup& soup, std::span<const IndexTriangle> corners,
         std::span<const NearFaces> pairs, double distance);

  // Moves points into the planes of all levels that they are in. Where these meet farther off than
  // the radius, points stay. `corners` are those that the triangles have now.
  void move_points(std::span<const IndexTriangle> corners, double radius,
                   std::vector<Vec3d>& points) const;

 private:
  struct Level {
    Vec3d normal = Vec3d::Zero();  // of length 1
    Vec3d at = Vec3d::Zero();

    [[nodiscard]] double height_of(const Vec3d& p) const { return normal.dot(p - at); }
  };
  using Neighbours = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  void grow(std::uint32_t first, const TriangleSoup& soup, std::span<const IndexTriangle> corners,
            const Neighbours& neighbours, double distance);
  [[nodiscard]] Vec3d place_in(std::span<const std::pair<std::uint32_t, std::uint32_t>> levels,
                               Vec3d place) const;

  std::vector<Level> levels_;
  std::vector<std::uint32_t> level_of_;  // of each triangle; kNone: none
};

}  // namespace meshrepair::internal
