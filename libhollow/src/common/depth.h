// SPDX-License-Identifier: MIT
// How deep a point is below the surface of a solid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <check/internal/nearest_triangle.h>
#include <check/soup_rays.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// A point, how far it is from the surface, and the triangle that is nearest to it, by its position
// in Depth::triangles().
struct Place {
  Vec3d at = Vec3d::Zero();
  double distance = 0;
  std::uint32_t nearest = 0;
};

class Depth {
 public:
  // Closed, turned outward and free of self-intersections, with a triangle; has to stay.
  explicit Depth(const TriangleSoup& solid);

  // `hint` is any position in triangles(), best of a triangle that is near.
  [[nodiscard]] Place place(const Vec3d& at, std::uint32_t hint) const;
  // Exactly. The point is on no triangle.
  [[nodiscard]] bool is_inside(const Vec3d& at) const { return rays_.winding_at(at) > 0; }
  // The point of the surface that is nearest to it.
  [[nodiscard]] Vec3d foot(const Place& place) const {
    return nearest_point(place.at, triangles()[place.nearest]);
  }
  // From the surface to the place; the way on which the distance grows fastest.
  [[nodiscard]] Vec3d inward(const Place& place) const {
    return (place.at - foot(place)).normalized();
  }

  [[nodiscard]] std::span<const Corners> triangles() const { return nearest_.triangles(); }
  // Of the triangle at this position, its number in the solid.
  [[nodiscard]] std::uint32_t number(std::uint32_t position) const {
    return nearest_.tree().order()[position];
  }
  // Calls visit(corners) for all triangles in boxes that `reaches(box)` says yes to.
  template <class Reaches, class Visit>
  void visit(const Reaches& reaches, const Visit& visit_triangle) const {
    nearest_.tree().visit(reaches, [&](std::uint32_t t) { visit_triangle(corners_[t]); });
  }

 private:
  std::vector<std::int32_t> winding_;
  SoupRays rays_;
  std::vector<Corners> corners_;  // as given
  NearestTriangle nearest_;
};

}  // namespace meshrepair::internal
