// SPDX-License-Identifier: MIT
// An octree of bricks: a part of space is divided as long as triangles near it may face each other.
// Walls of a solid, two faces of a fold outward and what is flat or hardly curved do not; so of a
// surface hardly more is left than its narrow places.
#include "narrow_places.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include <check/internal/nearest_triangle.h>

namespace meshrepair::internal {
namespace {

// Of more triangles not all pairs are looked at, but the part of space is divided first.
constexpr std::size_t kMostPaired = 48, kMostPairedAtLast = 512;

// Around an opening walls face all ways, so that two of them are 120 degrees apart. The walls of an
// edge that is no sharper than 60 degrees need not be: see seal_openings().
constexpr double kFacing = -0.25;

// Within so much of one direction no two directions are at right angles.
constexpr double kHalfRightAngle = std::numbers::sqrt2 / 2;

}  // namespace

struct NarrowPlaces::Search {
  Brick size;
  std::size_t most;
  CancelCheck check;
  std::vector<Brick> found;
};

NarrowPlaces::NarrowPlaces(const TriangleSoup& soup, const Vec3d& low, double side, double width,
                           ProgressObserver* progress)
    : soup_(soup), low_(low), side_(side), width_(width), progress_(progress) {
  normals_.reserve(soup.triangles.size());
  for (const auto& [a, b, c] : soup.triangles) {
    const Vec3d &p = soup.points[a], &q = soup.points[b], &r = soup.points[c];
    normals_.push_back((q - p).cross(r - p).normalized());
  }
}

std::optional<std::vector<std::array<std::int32_t, 3>>> NarrowPlaces::find(
    const std::array<std::int32_t, 3>& size, std::size_t most) const {
  Search search{size, most, CancelCheck(progress_), {}};
  std::int32_t side = 1;
  while (side < *std::max_element(size.begin(), size.end())) side *= 2;
  Triangles all(soup_.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  descend(all, {0, 0, 0}, side, search);
  if (search.found.size() > most) return std::nullopt;
  return std::move(search.found);
}

void NarrowPlaces::descend(const Triangles& among, const Brick& low, std::int32_t side,
                           Search& search) const {
  search.check.tick();
  for (std::size_t k = 0; k < 3; ++k) {
    if (low[k] >= search.size[k]) return;
  }
  if (search.found.size() > search.most) return;
  const Triangles here = near(among, low, side);
  if (!may_face(here, side == 1 ? kMostPairedAtLast : kMostPaired)) return;
  if (side == 1) {
    search.found.push_back(low);
    return;
  }
  const std::int32_t half = side / 2;
  for (std::int32_t i = 0; i < 8; ++i) {
    const Brick part = {low[0] + half * (i & 1), low[1] + half * (i >> 1 & 1),
                        low[2] + half * (i >> 2)};
    descend(here, part, half, search);
  }
}

// What lies between two triangles so far apart is half as far from one of them.
NarrowPlaces::Triangles NarrowPlaces::near(const Triangles& among, const Brick& low,
                                           std::int32_t side) const {
  const double half = side * side_ / 2;
  const Vec3d centre = low_ + side_ * Vec3d(low[0], low[1], low[2]) + Vec3d::Constant(half);
  const double reach = half * std::numbers::sqrt3 + width_ / 2;
  Triangles here;
  for (const std::uint32_t t : among) {
    const auto& c = soup_.triangles[t];
    const Corners corners = {soup_.points[c[0]], soup_.points[c[1]], soup_.points[c[2]]};
    if (squared_distance(centre, corners) <= reach * reach) here.push_back(t);
  }
  return here;
}

bool NarrowPlaces::may_face(const Triangles& triangles, std::size_t most_paired) const {
  if (triangles.size() < 2) return false;
  Vec3d sum = Vec3d::Zero();
  for (const std::uint32_t t : triangles) sum += normals_[t];
  const Vec3d middle = sum.normalized();
  const bool is_cone = std::all_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
    return normals_[t].dot(middle) > kHalfRightAngle;
  });
  if (is_cone) return false;
  if (triangles.size() > most_paired) return true;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (face_each_other(triangles[i], triangles[j])) return true;
    }
  }
  return false;
}

bool NarrowPlaces::face_each_other(std::uint32_t a, std::uint32_t b) const {
  return normals_[a].dot(normals_[b]) < kFacing && is_before(a, b) && is_before(b, a);
}

// Whether some of `a` lies before `b`.
bool NarrowPlaces::is_before(std::uint32_t a, std::uint32_t b) const {
  const auto &of_a = soup_.triangles[a], &of_b = soup_.triangles[b];
  return std::any_of(of_a.begin(), of_a.end(), [&](std::uint32_t p) {
    return (soup_.points[p] - soup_.points[of_b[0]]).dot(normals_[b]) > 0;
  });
}

}  // namespace meshrepair::internal
