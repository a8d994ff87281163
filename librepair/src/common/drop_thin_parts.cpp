// SPDX-License-Identifier: MIT
#include "drop_thin_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <check/part_orientation.h>
#include <mesh/mesh_parts.h>

namespace meshrepair::internal {
namespace {

// Of each part: no thicker than this, on average?
std::vector<char> thin_parts(const TriangleSoup& mesh, const std::vector<std::uint32_t>& part_of,
                             std::uint32_t parts, double thickness) {
  const UnitScale scale(mesh.points);
  std::vector<char> thin;
  thin.reserve(parts);
  // A slab has two faces.
  for (const PartSize& size : part_sizes(mesh.points, mesh.triangles, part_of, parts, scale)) {
    thin.push_back(2 * std::abs(size.volume) <= size.area * scale(thickness) ? 1 : 0);
  }
  return thin;
}

std::vector<char> flags_of_triangles(const std::vector<std::uint32_t>& part_of,
                                     const std::vector<char>& of_part) {
  std::vector<char> flags;
  flags.reserve(part_of.size());
  for (const std::uint32_t part : part_of) flags.push_back(of_part[part]);
  return flags;
}

// None if all would go. Returns how many went.
std::size_t drop_parts(Surface& surface, const MeshParts& parts, std::vector<char> drop) {
  const auto dropped = static_cast<std::size_t>(std::count(drop.begin(), drop.end(), 1));
  if (dropped == 0 || dropped == drop.size()) return 0;
  for (char& flag : drop) flag = flag == 0 ? 1 : 0;
  keep_triangles(surface, flags_of_triangles(parts.of_triangle, drop));
  return dropped;
}

// As drop_inside_out_parts(), without a look at what then is around the others.
InsideOutParts drop_once(Surface& surface, double reach, ProgressObserver* progress) {
  TriangleSoup& mesh = surface.mesh;
  const PartOrientation parts = examine_part_orientation(mesh, progress);
  const auto wrong = std::count(parts.inside_out.begin(), parts.inside_out.end(), 1);
  if (wrong == 0) return {};
  // Both walls may have moved.
  const auto count = static_cast<std::uint32_t>(parts.inside_out.size());
  const std::vector<char> thin = thin_parts(mesh, parts.part_of, count, 2 * reach);
  InsideOutParts result;
  for (std::size_t part = 0; part < thin.size(); ++part) {
    if (parts.inside_out[part] != 0) ++(thin[part] != 0 ? result.dropped : result.left);
  }
  if (result.dropped == thin.size()) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return {};
  }
  std::vector<char> keep(thin.size(), 1);
  for (std::size_t part = 0; part < thin.size(); ++part) {
    if (parts.inside_out[part] != 0 && thin[part] != 0) keep[part] = 0;
  }
  if (result.dropped > 0) keep_triangles(surface, flags_of_triangles(parts.part_of, keep));
  return result;
}

}  // namespace

InsideOutParts drop_inside_out_parts(Surface& surface, double reach, ProgressObserver* progress) {
  InsideOutParts all;
  for (;;) {
    const InsideOutParts now = drop_once(surface, reach, progress);
    all.dropped += now.dropped;
    all.left = now.left;
    if (now.dropped == 0) return all;
  }
}

std::size_t drop_turned_parts(Surface& surface, const std::vector<Vec3d>& before) {
  const TriangleSoup& mesh = surface.mesh;
  const MeshParts parts = find_parts(mesh);
  const UnitScale scale(before);
  const auto sizes_by = [&](const std::vector<Vec3d>& points) {
    return part_sizes(points, mesh.triangles, parts.of_triangle, parts.count, scale);
  };
  const std::vector<PartSize> was = sizes_by(before);
  const std::vector<PartSize> is = before == mesh.points ? was : sizes_by(mesh.points);
  std::vector<char> drop(parts.count, 1);
  for (std::uint32_t part = 0; part < parts.count; ++part) {
    const double first = was[part].volume, now = is[part].volume;
    if ((first > 0 && now > 0) || (first < 0 && now < 0)) drop[part] = 0;
  }
  return drop_parts(surface, parts, std::move(drop));
}

std::size_t drop_thin_parts(Surface& surface, std::span<const std::uint32_t> among,
                            double thickness) {
  const MeshParts parts = find_parts(surface.mesh);
  const std::vector<char> thin =
      thin_parts(surface.mesh, parts.of_triangle, parts.count, thickness);
  std::vector<char> drop(parts.count, 0);
  for (const std::uint32_t t : among) drop[parts.of_triangle[t]] = thin[parts.of_triangle[t]];
  return drop_parts(surface, parts, std::move(drop));
}

std::size_t drop_thin_crumbs(Surface& surface, const std::vector<char>& whole, double thickness) {
  const MeshParts parts = find_parts(surface.mesh);
  if (parts.count == 1) return 0;
  std::vector<char> drop = thin_parts(surface.mesh, parts.of_triangle, parts.count, thickness);
  for (std::size_t t = 0; t < whole.size(); ++t) {
    if (whole[t] != 0) drop[parts.of_triangle[t]] = 0;
  }
  return drop_parts(surface, parts, std::move(drop));
}

}  // namespace meshrepair::internal
