// SPDX-License-Identifier: MIT
#include "rim_plane.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <base/angles.h>

namespace meshrepair::internal {
namespace {

Vec3d edge_of(const Rim& rim, std::size_t i) {
  return rim.points[(i + 1) % rim.size()] - rim.points[i];
}

double edge_length(const Rim& rim, std::size_t i) { return edge_of(rim, i).norm(); }

// Between the surface at an edge and the plane.
double angle_at(const Rim& rim, std::size_t i, const RimPlane& plane) {
  const Vec3d normal = edge_of(rim, i).cross(rim.apex[i] - rim.points[i]).normalized();
  return arc_cosine(std::clamp(std::abs(normal.dot(plane.normal)), 0.0, 1.0));
}

}  // namespace

RimPlane plane_of(const Rim& rim) {
  RimPlane plane;
  Vec3d middle = Vec3d::Zero();
  for (const Vec3d& p : rim.points) middle += p;
  middle /= static_cast<double>(rim.size());
  plane.normal = twice_vector_area(rim.points).normalized();
  for (const Vec3d& p : rim.points) {
    const double distance = std::abs(plane.normal.dot(p - middle));
    plane.farthest = std::max(plane.farthest, distance);
    plane.mean_distance += distance * distance / static_cast<double>(rim.size());
  }
  plane.mean_distance = std::sqrt(plane.mean_distance);
  return plane;
}

double mean_angle(const Rim& rim, const RimPlane& plane) {
  double sum = 0, length = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const double edge = edge_length(rim, i);
    sum += edge * angle_at(rim, i, plane);
    length += edge;
  }
  return length > 0 ? sum / length : 0;
}

double share_steeper(const Rim& rim, const RimPlane& plane, double angle) {
  double steep = 0, length = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const double edge = edge_length(rim, i);
    if (angle_at(rim, i, plane) > angle) steep += edge;
    length += edge;
  }
  return length > 0 ? steep / length : 0;
}

}  // namespace meshrepair::internal
