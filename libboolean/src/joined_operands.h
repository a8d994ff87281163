// Operands that touch but for small gaps.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <boolean/boolean.h>

namespace meshrepair::internal {

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
