// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include <mesh/triangulate_polygon.h>

#include "ear_clipper.h"

namespace meshrepair {
namespace {

using internal::Flat;
using internal::left_turn;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Up to here a fan is good enough, and is what users expect. The thin triangles of a larger one are
// crossed by whatever crosses the polygon.
constexpr std::size_t kFewCorners = 32;

// Positions in `corners`.
std::vector<std::uint32_t> without_repetitions(std::span<const std::uint32_t> corners) {
  std::vector<std::uint32_t> kept;
  kept.reserve(corners.size());
  std::size_t droppable = corners.size() - 3;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const bool repeated = !kept.empty() && corners[kept.back()] == corners[i];
    if (repeated && droppable > 0) {
      --droppable;
    } else {
      kept.push_back(i);
    }
  }
  while (droppable > 0 && corners[kept.back()] == corners[kept.front()]) {
    kept.pop_back();
    --droppable;
  }
  return kept;
}

std::vector<Vec3d> places_of(const std::vector<Vec3d>& points,
                             std::span<const std::uint32_t> corners,
                             std::span<const std::uint32_t> ring) {
  std::vector<Vec3d> places;
  places.reserve(ring.size());
  for (const std::uint32_t i : ring) places.push_back(points[corners[i]]);
  return places;
}

void append_fan(std::span<const std::uint32_t> corners, Triangles& triangles) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

// Twice the vector area (Newell), about the first corner.
Vec3d area_vector(std::span<const Vec3d> polygon) {
  Vec3d sum = Vec3d::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  }
  return sum;
}

// The corners without the coordinate in which the area vector is largest, mirrored where needed so
// that the polygon turns to the left.
std::vector<Flat> flatten(std::span<const Vec3d> polygon, const Vec3d& area) {
  Eigen::Index drop = 0;
  area.cwiseAbs().maxCoeff(&drop);
  Eigen::Index u = (drop + 1) % 3;
  Eigen::Index v = (drop + 2) % 3;
  if (area[drop] < 0) std::swap(u, v);
  std::vector<Flat> flat;
  flat.reserve(polygon.size());
  for (const Vec3d& corner : polygon) flat.emplace_back(corner[u], corner[v]);
  return flat;
}

bool is_star_shaped_from_first(const std::vector<Flat>& flat) {
  for (std::size_t i = 2; i < flat.size(); ++i) {
    if (!(left_turn(flat[0], flat[i - 1], flat[i]) > 0)) return false;
  }
  return true;
}

// A polygon of many corners that crosses itself still gives its ears, and one fan only of what is
// left: the triangles of a fan lie on each other, and in the end their plane falls into as many
// pieces as there are pairs of them.
void append_ears(const std::vector<Flat>& flat, std::span<const std::uint32_t> ring,
                 Triangles& triangles) {
  using internal::EarOrder;
  const bool few = ring.size() <= kFewCorners;
  const std::size_t count_before = triangles.size();
  const std::vector<std::uint32_t> rest =
      internal::clip_ears(flat, few ? EarOrder::around : EarOrder::in_rounds, triangles).rest;
  if (!rest.empty() && few) {
    triangles.resize(count_before);
    return append_fan(ring, triangles);
  }
  if (!rest.empty()) append_fan(rest, triangles);
  for (std::size_t i = count_before; i < triangles.size(); ++i) {
    for (std::uint32_t& corner : triangles[i]) corner = ring[corner];
  }
}

}  // namespace

void triangulate_polygon(const std::vector<Vec3d>& points, std::span<const std::uint32_t> corners,
                         Triangles& triangles) {
  const std::vector<std::uint32_t> ring = without_repetitions(corners);
  if (ring.size() == 3) return append_fan(ring, triangles);
  const std::vector<Vec3d> polygon = places_of(points, corners, ring);
  const Vec3d area = area_vector(polygon);
  if (!area.allFinite() || area.isZero(0)) return append_fan(ring, triangles);
  const std::vector<Flat> flat = flatten(polygon, area);
  if (ring.size() <= kFewCorners && is_star_shaped_from_first(flat)) {
    return append_fan(ring, triangles);
  }
  append_ears(flat, ring, triangles);
}

}  // namespace meshrepair
