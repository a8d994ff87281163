// SPDX-License-Identifier: MIT
// Which solids each chamber of an arrangement is in.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <extract/arrange.h>

#include "joined_solids.h"

namespace meshrepair::internal {

// Of each chamber the solids that wind around it, ascending. Nothing where their windings
// contradict each other, as a solid is not closed on the grid. Linear in the walls and the solids
// around them.
[[nodiscard]] std::optional<std::vector<std::vector<std::uint32_t>>> solids_of_chambers(
    const Arrangement& arrangement, const JoinedSolids& joined);

// The same where they contradict each other, each solid by the rule of inside_rule.h. Linear in the
// product of the walls and the solids.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> likely_solids_of_chambers(
    const Arrangement& arrangement, const JoinedSolids& joined, ProgressObserver* progress);

}  // namespace meshrepair::internal
