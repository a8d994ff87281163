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

// What join_gaps() makes of all operands together. One that it brought parts of together is
// repaired. Nothing where there are no gaps. Throws ValueError, as that does.
[[nodiscard]] std::optional<JoinedOperands> join_operands(std::span<const TriangleSoup> solids,
                                                          const BooleanOptions& options,
                                                          JoinGapsReport& report);

}  // namespace meshrepair::internal
