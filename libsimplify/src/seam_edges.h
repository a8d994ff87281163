// SPDX-License-Identifier: MIT
// Edges of a mesh that gets fewer triangles at which something else than the surface changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mesh/internal/collapsible_mesh.h>

#include "collapse_guard.h"

namespace meshrepair::internal {

class SeamEdges {
 public:
  // See DecimationOptions::seams. The mesh has to stay, and changes as collapses are made.
  SeamEdges(const CollapsibleMesh& mesh, std::span<const std::uint8_t> sides);

  [[nodiscard]] bool empty() const { return sides_.empty(); }
  // Side k runs from corner k of the triangle to the next one.
  [[nodiscard]] bool is_seam(std::size_t triangle, std::uint32_t side) const;
  // The same of the side between two of its corners.
  [[nodiscard]] bool is_seam_between(std::uint32_t triangle, std::uint32_t a,
                                     std::uint32_t b) const;
  // Of each point how many seams end there; 127 where there are more.
  [[nodiscard]] std::vector<std::uint8_t> count_ends(std::size_t points) const;

  // Whether two seams become one when the star's point is moved onto link[to].
  [[nodiscard]] bool would_join(const PointStar& star, std::size_t to) const;
  // Before that is done: two edges of a triangle that goes become one, and if one of them is a
  // seam, so is that.
  void collapse(const PointStar& star, std::size_t to, const Collapse& collapse);

 private:
  const CollapsibleMesh& mesh_;
  std::vector<std::uint8_t> sides_;  // of each triangle, a bit for each
};

}  // namespace meshrepair::internal
