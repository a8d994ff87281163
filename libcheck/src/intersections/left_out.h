// SPDX-License-Identifier: MIT
// Pairs of triangles that a comparison leaves out.
#pragma once

#include <cstdint>
#include <span>

#include <base/ids.h>

namespace meshrepair::internal {

// Are items i and j in one of the groups? Empty: there are none.
[[nodiscard]] inline bool have_one_group(std::span<const std::uint32_t> groups, std::uint32_t i,
                                         std::uint32_t j) {
  return !groups.empty() && groups[i] != kNone && groups[i] == groups[j];
}

}  // namespace meshrepair::internal
