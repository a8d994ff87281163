// SPDX-License-Identifier: MIT
// Which rims of holes face each other across a gap.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <base/progress.h>

#include "rim.h"

namespace meshrepair::internal {

// Pairs of loops, the lower first, of which each is the one nearest to most of some points of the
// other. Each loop is in one pair at most. `rims` have coordinates in common. Takes a bounded
// number of steps: among very many rims that lie alike, pairs may be missing. `progress` is asked
// whether to go on.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> find_facing_rims(
    std::span<const Rim> rims, ProgressObserver* progress);

}  // namespace meshrepair::internal
