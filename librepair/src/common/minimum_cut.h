// SPDX-License-Identifier: MIT
// Parting the nodes of a graph in two at least cost.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace meshrepair::internal {

// What it costs to have the node in the set, and what to have it out of it.
struct CutNode {
  std::int64_t in = 0;
  std::int64_t out = 0;
};

// What it costs if just one of the two is in the set. There may be several between the same two.
struct CutEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::int64_t cost = 0;
};

// The cost of what must not be. All others together are to be less, and none is negative.
inline constexpr std::int64_t kForbidden = std::int64_t{1} << 61;

// Of each node, whether it is in the set of least total cost: of several such sets, in the one that
// all others contain. Nothing must be forbidden both in the set and out of it, alone or through
// edges. By augmenting paths (Boykov and Kolmogorov 2004): about linear where most paths are short.
[[nodiscard]] std::vector<char> minimum_cut(std::span<const CutNode> nodes,
                                            std::span<const CutEdge> edges);

}  // namespace meshrepair::internal
