// SPDX-License-Identifier: MIT
// Cubes around the places where a way is closed off, as triangles that divide space there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

#include "ball_reach.h"
#include "space_grid.h"

namespace meshrepair::internal {

struct SealLattice {
  // Faces of cubes, two triangles each; then markers, four each: small tetrahedra around the
  // centres of cubes.
  TriangleSoup soup;
  std::size_t first_marker = 0;  // in soup.triangles
  std::vector<char> is_behind;   // of each marker: to be closed off; else the ball comes there

  static constexpr std::size_t kTrianglesOfMarker = 4;
};

// All cubes that are up to `around` cubes away from a face that closes something off. There, space
// is divided finely enough for the two sides to be parted. Markers tell which side is which.
[[nodiscard]] SealLattice make_seal_lattice(const SpaceGrid& grid, const BallReach& reach,
                                            const std::vector<BallReach::Face>& closed,
                                            std::int32_t around);

}  // namespace meshrepair::internal
