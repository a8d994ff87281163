// SPDX-License-Identifier: MIT
// Where the corners of a surface that gets fewer triangles lie on the surface that it was.
//
// Each corner knows a triangle of the first surface, from which its place is found by going to
// neighbours as long as they are nearer. Nothing goes over seams, so a corner stays on the side on
// which it was, of however many charts a texture has.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <base/vec3.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

class CornerPlaces {
 public:
  // Of a closed mesh; see DecimationOptions::seams.
  CornerPlaces(std::span<const IndexTriangle> triangles, std::vector<Vec3d> points,
               std::span<const std::uint8_t> seams);

  // Corners of one point that no seam parts, 3 t + k for corner k of triangle t, have come to
  // `place`. All of them have one place on the first surface from now on.
  void move(std::span<const std::uint32_t> corners, const Vec3d& place);

  // Whether one of the corners would not be farther from the first surface there, squared.
  [[nodiscard]] bool is_within(std::span<const std::uint32_t> corners, const Vec3d& place,
                               double most_squared);

  // The triangle of the first surface that a corner lies on.
  [[nodiscard]] std::uint32_t triangle(std::uint32_t corner) const { return triangle_of_[corner]; }
  // The nearest point of that triangle.
  [[nodiscard]] Vec3d nearest(std::uint32_t corner, const Vec3d& place) const;

 private:
  [[nodiscard]] std::array<Vec3d, 3> corners_of(std::uint32_t triangle) const;
  [[nodiscard]] std::uint32_t nearest_of(std::span<const std::uint32_t> corners,
                                         const Vec3d& place) const;
  [[nodiscard]] std::uint32_t nearest_from(std::uint32_t triangle, const Vec3d& place,
                                           double enough_squared = -1);

  std::vector<IndexTriangle> triangles_;
  std::vector<Vec3d> points_;
  std::vector<std::array<std::uint32_t, 3>> beyond_;  // each side; kNone: a seam
  std::vector<std::uint32_t> triangle_of_;            // of each corner
  std::vector<std::uint32_t> looked_at_by_;           // of each triangle, its last search
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> to_look_at_;
};

}  // namespace meshrepair::internal
