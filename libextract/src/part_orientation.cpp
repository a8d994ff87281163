#include <bsp/disjoint_sets.h>
#include <bsp/volume_sign.h>
#include <extract/part_orientation.h>

#include "part_nesting.h"

namespace meshrepair {
namespace {

// Numbered by their first triangles. Returns how many there are.
std::uint32_t find_parts(const TriangleSoup& mesh, std::vector<std::uint32_t>& part_of) {
  DisjointSets joined(mesh.points.size());
  for (const auto& t : mesh.triangles) {
    joined.join(t[0], t[1]);
    joined.join(t[0], t[2]);
  }
  std::vector<std::uint32_t> number(mesh.points.size(), internal::kNoPart);
  std::uint32_t parts = 0;
  for (const auto& t : mesh.triangles) {
    std::uint32_t& part = number[joined.root(t[0])];
    if (part == internal::kNoPart) part = parts++;
    part_of.push_back(part);
  }
  return parts;
}

}  // namespace

PartOrientation examine_part_orientation(const TriangleSoup& mesh, ProgressObserver* progress) {
  PartOrientation orientation;
  const std::uint32_t parts = find_parts(mesh, orientation.part_of);
  std::vector<std::vector<std::uint32_t>> members(parts);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    members[orientation.part_of[t]].push_back(t);
  }
  const std::vector<std::uint32_t> depths =
      internal::nesting_depths(mesh, orientation.part_of, parts, progress);
  for (std::uint32_t part = 0; part < parts; ++part) {
    const int right = depths[part] % 2 == 0 ? 1 : -1;
    orientation.inside_out.push_back(volume_sign(mesh, members[part]) == right ? 0 : 1);
  }
  return orientation;
}

}  // namespace meshrepair
