// SPDX-License-Identifier: MIT
// Which rims are those of open sheets, and not of holes in something hollow: by how the surface
// arrives there, and by how large the hole is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rim.h"

namespace meshrepair::internal {

// What a rim is the end of. Areas in any unit.
struct RimOfSheet {
  std::uint32_t sheet = 0;
  double sheet_area = 0;
  double patch_area = 0;  // of a patch over the rim
};

// Of each rim, whether it stays open where HoleOptions::sheets_stay_open is set: see there. `ends`
// has one for each rim.
[[nodiscard]] std::vector<char> find_sheet_rims(std::span<const Rim> rims,
                                                std::span<const RimOfSheet> ends);

// A hole that may be patched.
struct Opening {
  std::uint32_t part = 0;  // that it is in
  double area = 0;         // of its patch
  double most = 0;         // that may be, as a share
};

// For each opening whether its patch has more than that share of the area of all else of its part,
// closed: of the surface that is there, part_area[part], and of the other patches. What is too
// large is no patch, so it is found from the largest one on. Takes n log n.
[[nodiscard]] std::vector<char> find_large_openings(std::span<const Opening> openings,
                                                    std::vector<double> part_area);

}  // namespace meshrepair::internal
