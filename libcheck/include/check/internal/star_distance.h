// SPDX-License-Identifier: MIT
// How far the triangles around a point are from those that replace them when the point goes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::internal {

// Seen along the mean normal of a star, z towards the eye; its centre is the origin.
struct StarPoint {
  double x, y, z;
};

class StarDistance {
 public:
  // `link` counter-clockwise around the centre as seen from outside.
  void set_star(const Vec3d& centre, std::span<const Vec3d> link);

  // No point of the triangles from link[to] to the edges of the link is farther from the star than
  // this; infinite where that would be more than `most`, or where, seen along the mean normal,
  // triangles of either star do not lie beside each other.
  [[nodiscard]] double bound(std::size_t to, double most) const;

 private:
  [[nodiscard]] std::size_t after(std::size_t i) const { return i + 1 == link_.size() ? 0 : i + 1; }
  [[nodiscard]] bool is_flat_fan() const;

  std::vector<StarPoint> link_;  // at most 1 along each axis
  double unit_ = 1;              // of the coordinates, a power of two
  bool is_flat_fan_ = false;
};

}  // namespace meshrepair::internal
