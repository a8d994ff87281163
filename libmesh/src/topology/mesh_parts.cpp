// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <base/parallel.h>
#include <base/shared_sets.h>
#include <mesh/mesh_parts.h>

namespace meshrepair {

MeshParts find_parts(const TriangleSoup& mesh) {
  SharedSets joined(mesh.points.size());
  parallel_for(mesh.triangles.size(), [&](std::size_t t) {
    const auto& corners = mesh.triangles[t];
    joined.join(corners[0], corners[1]);
    joined.join(corners[0], corners[2]);
  });
  MeshParts parts;
  parts.of_triangle.reserve(mesh.triangles.size());
  std::vector<std::uint32_t> number(mesh.points.size(), kNone);
  for (const auto& t : mesh.triangles) {
    std::uint32_t& part = number[joined.root(t[0])];
    if (part == kNone) part = parts.count++;
    parts.of_triangle.push_back(part);
  }
  return parts;
}

UnitScale::UnitScale(std::span<const Vec3d> points) {
  double largest = 0;
  for (const Vec3d& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  int exponent = 0;
  (void)std::frexp(largest, &exponent);
  // Half each, as the inverse of a number may be beyond the largest one.
  const int half = -exponent / 2;
  first_ = std::ldexp(1.0, half);
  second_ = std::ldexp(1.0, -exponent - half);
}

std::vector<PartSize> part_sizes(std::span<const Vec3d> points,
                                 std::span<const std::array<std::uint32_t, 3>> triangles,
                                 std::span<const std::uint32_t> part_of, std::uint32_t parts,
                                 const UnitScale& scale) {
  std::vector<PartSize> sizes(parts);
  std::vector<Vec3d> bases(parts);
  std::vector<char> has_base(parts, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t part = part_of[t];
    const auto& corners = triangles[t];
    if (has_base[part] == 0) bases[part] = scale(points[corners[0]]);
    has_base[part] = 1;
    const Vec3d a = scale(points[corners[0]]) - bases[part];
    const Vec3d b = scale(points[corners[1]]) - bases[part];
    const Vec3d c = scale(points[corners[2]]) - bases[part];
    sizes[part].volume += a.dot(b.cross(c)) / 6;
    sizes[part].area += (b - a).cross(c - a).norm() / 2;
  }
  return sizes;
}

}  // namespace meshrepair
