// SPDX-License-Identifier: MIT
#include "touching_middles.h"

#include <algorithm>
#include <span>
#include <utility>

#include <base/ids.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

TouchingMiddles::TouchingMiddles(const SheetEdges& edges, const KeptFacets& kept,
                                 const SheetRegions& regions,
                                 const std::vector<std::uint32_t>& fan) {
  using Ends = std::pair<std::uint32_t, std::uint32_t>;
  const auto ends = [&](std::uint32_t s) { return Ends(fan[s], fan[next_side(s)]); };
  const auto begins_pair = [&](std::uint32_t s) {
    return kept.mate[s] != kNone && kept.singular[s] != 0 && s < kept.mate[s];
  };
  const auto add = [&](std::uint32_t s) {
    auto [from, to] = ends(s);
    if (kept.kept[s / 3] == Kept::turned_round) std::swap(from, to);
    sides_.push_back({{regions.region[s / 3], from, to}, static_cast<std::uint32_t>(count_)});
  };
  std::vector<Ends> taken;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::span<const std::uint32_t> slots = edges.slots(e);
    taken.clear();
    for (const std::uint32_t s : slots) {
      if (begins_pair(s)) taken.push_back(std::minmax({ends(s).first, ends(s).second}));
    }
    std::sort(taken.begin(), taken.end());
    if (std::adjacent_find(taken.begin(), taken.end()) == taken.end()) continue;
    for (const std::uint32_t s : slots) {
      if (!begins_pair(s)) continue;
      add(s);
      add(kept.mate[s]);
      ++count_;
    }
  }
  std::sort(sides_.begin(), sides_.end(),
            [](const Side& a, const Side& b) { return a.key < b.key; });
}

std::uint32_t TouchingMiddles::find(std::uint32_t region, std::uint32_t from,
                                    std::uint32_t to) const {
  const std::array key = {region, from, to};
  const auto found = std::lower_bound(sides_.begin(), sides_.end(), key,
                                      [](const Side& side, const auto& k) { return side.key < k; });
  return found == sides_.end() || found->key != key ? kNone : found->middle;
}

// Each new edge ends in a middle: those between corners might be there already.
void split_at_middles(const IndexTriangle& corners, const IndexTriangle& middles,
                      std::vector<IndexTriangle>& pieces) {
  const auto split = static_cast<std::size_t>(
      std::count_if(middles.begin(), middles.end(), [](std::uint32_t m) { return m != kNone; }));
  const auto corner = [&](std::size_t k) { return corners[k % 3]; };
  const auto middle = [&](std::size_t k) { return middles[k % 3]; };
  if (split == 0) {
    pieces.push_back(corners);
    return;
  }
  if (split == 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      pieces.push_back({middle(k + 2), corner(k), middle(k)});
    }
    pieces.push_back(middles);
    return;
  }
  std::size_t k = 0;  // the only side with a middle, or the first of two
  while (middle(k) == kNone || (split == 2 && middle(k + 1) == kNone)) ++k;
  pieces.push_back({corner(k), middle(k), split == 1 ? corner(k + 2) : middle(k + 1)});
  if (split == 2) pieces.push_back({corner(k), middle(k + 1), corner(k + 2)});
  pieces.push_back({middle(k), corner(k + 1), split == 1 ? corner(k + 2) : middle(k + 1)});
}

}  // namespace meshrepair::internal
