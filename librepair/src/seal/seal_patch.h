// Triangles across the ways that are closed off.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <check/soup_rays.h>
#include <mesh/soup.h>

#include "ball_reach.h"
#include "space_grid.h"

namespace meshrepair::internal {

struct SealPatch {
  TriangleSoup soup;
  std::size_t pieces = 0;  // that are connected
};

// The faces made smooth. Their borders lie beside walls, less than two steps away: a ring goes on
// from there until it is behind these.
[[nodiscard]] SealPatch make_seal_patch(const SpaceGrid& grid, const SoupRays& rays,
                                        const std::vector<BallReach::Face>& faces);

}  // namespace meshrepair::internal
