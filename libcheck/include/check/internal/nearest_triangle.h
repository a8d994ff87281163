// SPDX-License-Identifier: MIT
// The triangle of a mesh that is nearest to a point.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <base/raw_vector.h>
#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

using Corners = std::array<Vec3d, 3>;

// A point of the triangle that is the nearest but for rounding.
[[nodiscard]] Vec3d nearest_point(const Vec3d& p, const Corners& triangle);

// The square of the distance to that. The point is on the triangle whatever was rounded, so the
// true distance is not larger by more than the rounding of one sum of coordinates.
[[nodiscard]] double squared_distance(const Vec3d& p, const Corners& triangle);

struct Nearest {
  double squared_distance = 0;
  std::uint32_t triangle = 0;  // a position in NearestTriangle::triangles()
};

class NearestTriangle {
 public:
  // All triangles are finite; there is at least one.
  explicit NearestTriangle(std::span<const Corners> triangles);

  // `hint` is any triangle, best one that is near: it makes the search faster.
  [[nodiscard]] Nearest find(const Vec3d& p, std::uint32_t hint) const;

  // In the order of the tree.
  [[nodiscard]] std::span<const Corners> triangles() const { return triangles_; }
  // Of their boxes; its items are the numbers of the triangles as they were given.
  [[nodiscard]] const BoxTree& tree() const { return tree_; }

 private:
  struct Ball {
    Ball() = default;
    explicit Ball(const Corners& triangle);
    // None of it is nearer to the point than that.
    [[nodiscard]] bool is_beyond(const Vec3d& p, double distance) const {
      const double both = distance + radius;
      return (p - centre).squaredNorm() >= both * both;
    }
    Vec3d centre;
    double radius;
  };

  BoxTree tree_;
  RawVector<Corners> triangles_;
  RawVector<Ball> balls_;  // around each: a look at that spares most looks at the triangle
};

}  // namespace meshrepair::internal
