// SPDX-License-Identifier: MIT
// Which closed parts of a surface lie inside which others? Exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// `part_of` gives the part of each triangle, or kNoPart for those to be passed over; the parts 0 to
// parts - 1 are closed. Finds the other parts around each, by a point within its first triangle,
// next to a corner. That is the nesting of all of it if no two triangles meet.
inline constexpr std::uint32_t kNoPart = ~std::uint32_t{0};

struct PartNesting {
  std::vector<std::uint32_t> depth;   // of each part: how many others are around it
  std::vector<std::uint32_t> around;  // the innermost one of these; kNoPart: there are none
};

[[nodiscard]] PartNesting find_nesting(const TriangleSoup& soup,
                                       std::span<const std::uint32_t> part_of, std::size_t parts,
                                       ProgressObserver* progress);

}  // namespace meshrepair::internal
