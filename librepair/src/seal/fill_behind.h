// SPDX-License-Identifier: MIT
// Which chambers lie behind openings, once a lattice divides these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <extract/arrange.h>

#include "seal_lattice.h"

namespace meshrepair::internal {

// Chambers that patches alone part, and that become solid.
struct FilledSpace {
  std::vector<std::uint32_t> chambers;
  double volume = 0;         // in cubic grid steps
  double patches_area = 0;   // that close its openings, in square grid steps
  std::size_t openings = 0;  // that are closed: pieces of these patches
};

struct FilledChambers {
  std::vector<char> solid;  // of each chamber: it is, or lies behind an opening
  std::vector<FilledSpace> spaces;
  std::size_t leaks = 0;  // chambers behind openings that the outside leads into all the same
};

// `soup` is the surface of a solid with `solid_triangles` triangles, then the lattice's, and
// Triangle::source counts them. The patches are those faces of the lattice that have the least area
// and part what lies behind openings from where the ball comes. Nothing if the surface does not
// wind around a solid.
[[nodiscard]] std::optional<FilledChambers> fill_behind(const CleanSoup& soup,
                                                        std::size_t solid_triangles,
                                                        const SealLattice& lattice,
                                                        const Arrangement& arrangement,
                                                        ProgressObserver* progress);

}  // namespace meshrepair::internal
