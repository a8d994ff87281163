// SPDX-License-Identifier: MIT
// Bodies that are hollow by mistake: an inner wall follows the outer one, and is joined to it
// around pinholes and nowhere else.
//
// An image-to-3D generator makes such a body, as it asks how near a surface is, not on which side
// of it a place lies. A bottle, a bird house or a ball with a drain hole is like it, but for the
// size of the opening:
//
// - Triangles that are seen from outside are of the outer wall. What lies behind most of them, no
//   deeper than 8 % of the body, faces them and is not seen: the inner wall.
// - The least cut between the two, by length, are the rims of openings. They are pinholes where
// each
//   is narrower than 1 % of the body, or has 12 edges at most, as long as those of the whole body,
//   and is narrower than 8 %. Where six or more are, and seven of ten, others may have up to 80
//   edges: pinholes that lie side by side. All together are small beside the inner wall.
#pragma once

#include <cstddef>
#include <vector>

#include <base/progress.h>
#include <extract/surface.h>

namespace meshrepair::internal {

struct DoubleWalls {
  std::size_t bodies = 0;
  std::size_t pinholes = 0;
  double widest = 0;           // of the pinholes: the diameter of a circle of this length
  std::vector<char> is_inner;  // of each triangle: of an inner wall, or of a tube to it
};

// Bodies of fewer than 2,000 triangles have none. n log n, with a small
// factor where a body is not thin beside its extent. `progress` is asked whether to go on.
[[nodiscard]] DoubleWalls find_double_walls(const Surface& solid, ProgressObserver* progress);

}  // namespace meshrepair::internal
