// SPDX-License-Identifier: MIT
#include "faulty_groups.h"

#include <check/internal/triangle_list.h>
#include <mesh/mesh_parts.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

// Of a group's diagonal: points that move do not bring groups together that lie this far apart,
// mostly.
constexpr double kGroupMargin = 1e-3;

void add_degenerate(const TriangleSoup& mesh, std::vector<std::uint32_t>& triangles) {
  const SoupCorners corners(mesh, false);
  CornerTriangle fetched;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (corners.fetch(t, fetched) == Fetched::degenerate) triangles.push_back(t);
  }
}

void add_joined(const TriangleSoup& mesh, std::vector<std::uint32_t>& triangles) {
  const PointPlaces places = find_places(mesh.points);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t p : mesh.triangles[t]) {
      if (places.is_copy[p] == 0) continue;
      triangles.push_back(t);
      break;
    }
  }
}

// The groups that go, numbered.
MeshParts groups_that_go(const PartGroups& groups, std::span<const std::uint32_t> at_fault) {
  std::vector<std::uint32_t> number(groups.size(), kNoGroup);
  for (const std::uint32_t t : at_fault) number[groups.of_triangle[t]] = 0;
  MeshParts those;
  for (std::uint32_t& n : number) {
    if (n != kNoGroup) n = those.count++;
  }
  those.of_triangle.reserve(groups.of_triangle.size());
  for (const std::uint32_t group : groups.of_triangle) those.of_triangle.push_back(number[group]);
  return those;
}

}  // namespace

std::vector<std::uint32_t> triangles_at_fault(const TriangleSoup& mesh,
                                              const SelfIntersections& found, bool joins_points) {
  std::vector<std::uint32_t> triangles;
  for (const auto& pair : found.pairs) triangles.insert(triangles.end(), pair.begin(), pair.end());
  if (found.degenerate > 0) add_degenerate(mesh, triangles);
  if (joins_points) add_joined(mesh, triangles);
  return triangles;
}

PartGroups groups_apart(const TriangleSoup& mesh) { return find_groups(mesh, kGroupMargin); }

std::vector<Surface> take_groups(Surface& surface, const PartGroups& groups,
                                 std::span<const std::uint32_t> at_fault) {
  const MeshParts those = groups_that_go(groups, at_fault);
  std::vector<Surface> taken = divide_surface(surface, those);
  std::vector<char> stays;
  stays.reserve(those.of_triangle.size());
  for (const std::uint32_t group : those.of_triangle) stays.push_back(group == kNoGroup ? 1 : 0);
  keep_triangles(surface, stays);
  return taken;
}

}  // namespace meshrepair::internal
