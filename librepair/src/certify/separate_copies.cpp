// SPDX-License-Identifier: MIT
#include "separate_copies.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <base/angles.h>
#include <base/internal/hash_index.h>
#include <mesh/precision.h>
#include <mesh/weld_points.h>

#include "point_mover.h"

namespace meshrepair::internal {
namespace {

// Of each point: does an edge of its lie where one of its copies has one?
std::vector<char> find_common_edges(const TriangleSoup& mesh, const PointPlaces& places) {
  // From a place to a place, and the point that the edge starts at.
  std::vector<std::array<std::uint32_t, 3>> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = t[k];
      if (places.is_copy[p] == 0) continue;
      for (const std::uint32_t q : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
        edges.push_back({places.place[p], places.place[q], p});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<char> common(mesh.points.size(), 0);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const auto &a = edges[i - 1], &b = edges[i];
    if (a[0] == b[0] && a[1] == b[1] && a[2] != b[2]) common[a[2]] = common[b[2]] = 1;
  }
  return common;
}

// The unit normal of the triangle weighted by its angle at corner k, so that how a fan is cut into
// triangles does not matter.
Vec3d weighted_normal(const TriangleSoup& mesh, const std::array<std::uint32_t, 3>& t,
                      std::size_t k) {
  const Vec3d& at = mesh.points[t[k]];
  const Vec3d a = (mesh.points[t[(k + 1) % 3]] - at).normalized();
  const Vec3d b = (mesh.points[t[(k + 2) % 3]] - at).normalized();
  const Vec3d normal = a.cross(b);
  const double sine = normal.norm();
  if (!(sine > 0)) return Vec3d::Zero();
  return arc_tangent(sine, a.dot(b)) / sine * normal;
}

// Unit vectors out of the solid around each copy, or where copies were joined along an edge, into
// it; 0 for all other points.
std::vector<Vec3d> find_ways_out(const TriangleSoup& mesh, const PointPlaces& places,
                                 Touching touching) {
  std::vector<char> joined(mesh.points.size(), 0);
  if (touching == Touching::join) joined = find_common_edges(mesh, places);
  std::vector<Vec3d> out(mesh.points.size(), Vec3d::Zero());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (places.is_copy[t[k]] != 0) out[t[k]] += weighted_normal(mesh, t, k);
    }
  }
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const double length = out[p].norm();
    if (length > 0) out[p] *= (joined[p] != 0 ? -1 : 1) / length;
  }
  return out;
}

// In steps of the spacing.
constexpr std::array kDistances = {2.0, 8.0, 32.0};
// From where one try puts a point to where another one does.
constexpr double kCopyReach = 128;
// All as they should go, then all the other way, then each copy by chance: either way or not at
// all, then in any direction.
constexpr std::uint32_t kOrderlyTries = 6;
constexpr std::uint32_t kEitherWayTries = 18;
constexpr std::uint32_t kCopyTries = 30;
// Beyond this there are too many faults for chance to be a remedy.
constexpr std::size_t kMostTrianglesNear = 20'000;

// How far and where to for try k.
Vec3d move_of(const Vec3d& way_out, std::uint32_t point, std::uint32_t k) {
  if (k < kOrderlyTries) return (k % 2 == 0 ? -1 : 1) * kDistances[k / 2] * way_out;
  const double distance = kDistances[k % kDistances.size()];
  const std::uint64_t chance = hash_mix(hash_mix(point + 1, k), 0) >> 20;
  if (k < kEitherWayTries) return (static_cast<double>(chance % 5) - 2) / 2 * distance * way_out;
  Vec3d to;
  for (int axis = 0; axis < 3; ++axis) {
    to[axis] = static_cast<double>((chance >> (8 * axis)) % 256) / 127.5 - 1;
  }
  return distance * to;
}

// The same groups, by numbers without gaps: PointMover keeps a count for each number.
void number_anew(std::vector<std::uint32_t>& group) {
  std::vector<std::uint32_t> used = group;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t& g : group) {
    g = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), g) - used.begin());
  }
}

void keep_those_at_fault(TriangleSoup& mesh, std::vector<std::uint32_t>& points,
                         std::vector<std::uint32_t>& group, ProgressObserver* progress) {
  const PointMover all(mesh, points, group, 0, progress);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (all.faults_of(group[i]) == 0) continue;
    points[kept] = points[i];
    group[kept++] = group[i];
  }
  points.resize(kept);
  group.resize(kept);
}

}  // namespace

std::size_t count_copies(const TriangleSoup& mesh) {
  const PointPlaces places = find_places(mesh.points);
  return static_cast<std::size_t>(std::count(places.is_copy.begin(), places.is_copy.end(), 1));
}

void separate_copies(TriangleSoup& mesh, double spacing, Precision precision, Touching touching,
                     ProgressObserver* progress) {
  const PointPlaces places = find_places(mesh.points);
  const std::vector<Vec3d> ways_out = find_ways_out(mesh, places, touching);
  const std::vector<Vec3d> before = mesh.points;
  const auto moved = [&](std::uint32_t p, std::uint32_t k) {
    return rounded_to(before[p] + spacing * move_of(ways_out[p], p, k), precision);
  };
  std::vector<std::uint32_t> copies, group;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    if (places.is_copy[p] == 0) continue;
    copies.push_back(p);
    group.push_back(places.place[p]);
    mesh.points[p] = moved(p, 0);
  }
  number_anew(group);
  keep_those_at_fault(mesh, copies, group, progress);
  PointMover mover(mesh, copies, group, kCopyReach * spacing, progress);
  const std::uint32_t tries = mover.triangles() <= kMostTrianglesNear ? kCopyTries : kOrderlyTries;
  for (std::uint32_t k = 1; k < tries && mover.faults() > 0; ++k) {
    mover.try_moves([&](std::size_t i) { return moved(copies[i], k); });
  }
}

}  // namespace meshrepair::internal
