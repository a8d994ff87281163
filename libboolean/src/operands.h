// SPDX-License-Identifier: MIT
// What is done with solids before they are combined: those that touch but for small gaps are
// joined, and each comes onto the grid of all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <boolean/boolean.h>

#include "joined_solids.h"

namespace meshrepair::internal {

// The grid of all. Throws InputError where there are none.
[[nodiscard]] Grid grid_of(std::span<const TriangleSoup> solids);

// On that grid; without triangles where the solid has none. The report has room for it. Throws
// InputError where it is nothing there.
[[nodiscard]] CleanSoup clean_operand(const TriangleSoup& solid, std::size_t number,
                                      const Grid& grid, const BooleanOptions& options,
                                      BooleanReport& report);

// All on their grid, as one soup; the report gets an entry for each. Throws, as these two do.
[[nodiscard]] JoinedSolids join_solids(std::span<const TriangleSoup> solids,
                                       const BooleanOptions& options, BooleanReport& report);

[[noreturn]] void throw_too_small(std::size_t operand, const Grid& grid);

struct JoinedOperands {
  std::vector<TriangleSoup> solids;
  // Of each of their triangles, counted through all of them: that of the operands that were given.
  std::vector<std::uint32_t> source;
};

// What join_gaps() makes of all operands together. One that is no solid any more, as parts of it
// came together, is repaired. Nothing where there are no gaps. The report gets the stage, and what
// was joined. Throws ValueError, as join_gaps() does.
[[nodiscard]] std::optional<JoinedOperands> join_operands(std::span<const TriangleSoup> solids,
                                                          const BooleanOptions& options,
                                                          RepairReport& report);

// Of the solids that were given, instead of the joined ones.
[[nodiscard]] std::uint32_t given_source(const JoinedOperands& joined, std::uint32_t source);

}  // namespace meshrepair::internal
