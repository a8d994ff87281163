// SPDX-License-Identifier: MIT
// A piece is what is connected in one triangle. Pieces that lie in one place share all edges.
#include "stacks.h"

#include <algorithm>
#include <array>

#include <base/disjoint_sets.h>

namespace meshrepair::internal {

Stacks::Stacks(const Sheets& sheets, const SheetEdges& edges) {
  std::vector<std::array<std::uint32_t, 2>> same;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto slots = edges.slots(e);
    for (std::size_t i = 1; i < slots.size(); ++i) {
      if (edges.lies_on_previous(e, i)) same.push_back({slots[i - 1] / 3, slots[i] / 3});
    }
  }
  if (same.empty()) return;
  DisjointSets stacks(sheets.size());
  for (std::uint32_t s = 0; s < 3 * sheets.size(); ++s) {
    if (sheets.across[s] != kNone) stacks.join(s / 3, sheets.across[s] / 3);
  }
  for (const auto& [a, b] : same) stacks.join(a, b);
  std::vector<char> seen(sheets.size(), 0);
  for (const auto& [a, b] : same) seen[stacks.root(a)] = 1;
  stack_of_.assign(sheets.size(), kNone);
  for (std::uint32_t f = 0; f < sheets.size(); ++f) {
    const std::uint32_t stack = stacks.root(f);
    if (seen[stack] == 0) continue;
    stack_of_[f] = stack;
    facets_.push_back(f);
  }
  std::stable_sort(facets_.begin(), facets_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return stack_of_[a] < stack_of_[b]; });
}

}  // namespace meshrepair::internal
