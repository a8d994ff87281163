// SPDX-License-Identifier: MIT
// Keeps the points of a surface near the one with fewer triangles that it becomes.
//
// Each corner of the first surface, from when it moved on, and the middle of each edge hangs on the
// triangle that is nearest to it of those that took the place of the one where it was (R. Klein, G.
// Liebich and W. Strasser: Mesh reduction with error control, 1996). A collapse changes the
// triangles of its fan alone, so only their points are looked at.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <base/vec3.h>
#include <mesh/edge_table.h>

#include "collapse_guard.h"

namespace meshrepair::internal {

class DistanceGuard {
 public:
  // No point may come to be farther than `most` from the triangle that it hangs on.
  DistanceGuard(std::vector<Vec3d> points, std::span<const IndexTriangle> triangles, double most);

  // Whether the collapse may be, as far as points of the first surface are concerned. `points` are
  // those of the mesh before it.
  [[nodiscard]] bool allows(const Collapse& collapse, std::span<const Vec3d> points);
  // After the collapse that was asked about last has been made.
  void note_made(const Collapse& collapse);

 private:
  void list_points(const Collapse& collapse);

  std::vector<Vec3d> given_;  // corners, then middles
  const double most_squared_;
  std::vector<std::uint32_t> first_;  // point of each triangle; kNone: none
  std::vector<std::uint32_t> next_;   // of each point, on the same triangle
  std::vector<char> hangs_;           // of each corner
  // Of the collapse that was asked about last: points, and the positions in the fan of the
  // triangles on which they are to hang.
  std::vector<std::uint32_t> listed_, nearest_;
};

}  // namespace meshrepair::internal
