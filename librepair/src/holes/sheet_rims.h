// Which rims are those of open sheets, and not of holes in something hollow.
#pragma once

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

}  // namespace meshrepair::internal
