#include "faulty_groups.h"

#include <check/triangle_list.h>
#include <mesh/mesh_parts.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

// Of a group's diagonal: points that move do not bring groups together that lie this far apart,
// mostly.
constexpr double kMargin = 1e-3;

constexpr std::uint32_t kStays = ~std::uint32_t{0};

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

// Of each group its number among those that go, or kStays.
std::vector<std::uint32_t> numbers_of(const PartGroups& groups,
                                      std::span<const std::uint32_t> at_fault) {
  std::vector<std::uint32_t> number(groups.size(), kStays);
  for (const std::uint32_t t : at_fault) number[groups.of_triangle[t]] = 0;
  std::uint32_t count = 0;
  for (std::uint32_t& n : number) {
    if (n != kStays) n = count++;
  }
  return number;
}

// The groups that have a number.
std::vector<Surface> numbered_groups(const Surface& surface, const PartGroups& groups,
                                     const std::vector<std::uint32_t>& number,
                                     const std::vector<char>& goes) {
  Surface all = surface;
  keep_triangles(all, goes);
  MeshParts those;
  for (const std::uint32_t group : groups.of_triangle) {
    if (number[group] != kStays) those.of_triangle.push_back(number[group]);
  }
  for (const std::uint32_t n : number) those.count += n == kStays ? 0 : 1;
  return divide_surface(all, those);
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

PartGroups groups_apart(const TriangleSoup& mesh) { return find_groups(mesh, kMargin); }

std::vector<Surface> take_groups(Surface& surface, const PartGroups& groups,
                                 std::span<const std::uint32_t> at_fault) {
  const std::vector<std::uint32_t> number = numbers_of(groups, at_fault);
  std::vector<char> flags;
  flags.reserve(groups.of_triangle.size());
  for (const std::uint32_t group : groups.of_triangle) flags.push_back(number[group] != kStays);
  std::vector<Surface> taken = numbered_groups(surface, groups, number, flags);
  for (char& flag : flags) flag = flag == 0 ? 1 : 0;
  keep_triangles(surface, flags);
  return taken;
}

}  // namespace meshrepair::internal
