// SPDX-License-Identifier: MIT
#include <algorithm>

#include <exact/predicates.h>
#include <extract/float_engine.h>

namespace meshrepair {
namespace {

double largest_side(const GridBox& box) {
  return std::max({static_cast<double>(box.high.x) - box.low.x,
                   static_cast<double>(box.high.y) - box.low.y,
                   static_cast<double>(box.high.z) - box.low.z});
}

}  // namespace

std::string_view predicates_name(Predicates predicates) {
  return predicates == Predicates::exact ? "exact" : "float";
}

Point interpolate(const Point& a, const Point& b, const Plane& plane) {
  const double of_a = signed_distance(a.position, plane);
  const double of_b = signed_distance(b.position, plane);
  const double ratio = of_a != of_b ? std::clamp(of_a / (of_a - of_b), 0.0, 1.0) : 0.5;
  std::array<double, 3> at{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at[axis] = a.position[axis] + ratio * (b.position[axis] - a.position[axis]);
  }
  return loose_point(at, std::max(a.error, b.error));
}

FloatEngine::FloatEngine(const CleanSoup& soup, double epsilon)
    : FloatEngine(epsilon * largest_side(bounding_box(soup))) {}

int FloatEngine::side(const Point& point, PlaneId plane, const PlaneTable& planes) {
  const double distance = signed_distance(point.position, planes[plane]);
  return (distance > tolerance_) - (distance < -tolerance_);
}

Point FloatEngine::cross(const Point& a, const Point& b, PlaneId, PlaneId, PlaneId plane,
                         const PlaneTable& planes) {
  return loose_point(interpolate(a, b, planes[plane]).position, tolerance_);
}

}  // namespace meshrepair
