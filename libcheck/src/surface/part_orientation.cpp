// SPDX-License-Identifier: MIT
#include <utility>

#include <check/part_orientation.h>
#include <exact/volume_sign.h>
#include <mesh/mesh_parts.h>

#include "part_nesting.h"

namespace meshrepair {
PartOrientation examine_part_orientation(const TriangleSoup& mesh, ProgressObserver* progress) {
  MeshParts found = find_parts(mesh);
  const std::uint32_t parts = found.count;
  PartOrientation orientation;
  orientation.part_of = std::move(found.of_triangle);
  std::vector<std::vector<std::uint32_t>> members(parts);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    members[orientation.part_of[t]].push_back(t);
  }
  internal::PartNesting nesting =
      internal::find_nesting(mesh, orientation.part_of, parts, progress);
  orientation.depth = std::move(nesting.depth);
  orientation.around = std::move(nesting.around);
  for (std::uint32_t part = 0; part < parts; ++part) {
    const int right = orientation.depth[part] % 2 == 0 ? 1 : -1;
    orientation.inside_out.push_back(
        volume_sign(mesh.points, mesh.triangles, members[part]) == right ? 0 : 1);
  }
  return orientation;
}

}  // namespace meshrepair
