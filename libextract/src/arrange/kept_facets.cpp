// SPDX-License-Identifier: MIT
#include "kept_facets.h"

#include <algorithm>

#include <base/disjoint_sets.h>
#include <base/ids.h>

namespace meshrepair::internal {
namespace {

constexpr std::uint8_t kOnSurface = 1, kWithin = 2, kBeyond = 4;

class FacetKeeper {
 public:
  FacetKeeper(const CleanSoup& soup, const Sheets& sheets, const SheetEdges& edges,
              const Stacks& stacks, const Chambers& chambers, const std::vector<char>& solid,
              Touching touching)
      : soup_(soup),
        sheets_(sheets),
        edges_(edges),
        stacks_(stacks),
        chambers_(chambers),
        solid_(solid),
        touching_(touching) {}

  KeptFacets run() {
    result_.kept.assign(sheets_.size(), Kept::no);
    result_.places.assign(sheets_.first.size() - 1, 0);
    for (std::uint32_t f = 0; f < sheets_.size(); ++f) {
      if (!stacks_.contains(f)) keep(f, solid_in_front(f), solid_behind(f));
    }
    stacks_.for_each([&](std::span<const std::uint32_t> stack) { keep_one_of(stack); });
    join();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool solid_in_front(std::uint32_t f) const {
    return solid_[chambers_.front[f]] != 0;
  }
  [[nodiscard]] bool solid_behind(std::uint32_t f) const {
    return solid_[chambers_.behind[f]] != 0;
  }

  void keep(std::uint32_t f, bool solid_in_front, bool solid_behind) {
    std::uint8_t& place = result_.places[sheets_.triangle[f]];
    if (solid_in_front == solid_behind) {
      place |= solid_in_front ? kWithin : kBeyond;
      return;
    }
    place |= kOnSurface;
    result_.kept[f] = solid_behind ? Kept::as_turned : Kept::turned_round;
  }

  // The pieces of the first triangle stand for all.
  void keep_one_of(std::span<const std::uint32_t> stack) {
    const std::uint32_t lowest = stack.front(), highest = stack.back();
    const bool solid_below = faces_along(lowest) ? solid_behind(lowest) : solid_in_front(lowest);
    const bool solid_above = faces_along(highest) ? solid_in_front(highest) : solid_behind(highest);
    for (const std::uint32_t f : stack) {
      if (sheets_.triangle[f] != sheets_.triangle[lowest]) break;
      const bool along = faces_along(f);
      keep(f, along ? solid_above : solid_below, along ? solid_below : solid_above);
    }
  }

  [[nodiscard]] bool faces_along(std::uint32_t f) const {
    return corner_side(soup_, sheets_.triangle[f]) > 0;
  }

  void join() {
    result_.mate.assign(3 * sheets_.size(), kNone);
    result_.singular.assign(3 * sheets_.size(), 0);
    for (std::uint32_t s = 0; s < 3 * sheets_.size(); ++s) {
      if (sheets_.across[s] != kNone && is_kept(s)) result_.mate[s] = sheets_.across[s];
    }
    std::vector<std::uint32_t> at;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      at.clear();
      for (const std::uint32_t s : edges_.slots(e)) {
        if (is_kept(s)) at.push_back(s);
      }
      if (!at.empty()) join_around(at);
    }
  }

  [[nodiscard]] bool is_kept(std::uint32_t slot) const {
    return result_.kept[slot / 3] != Kept::no;
  }

  // Whether what comes after the slot around its edge is solid.
  [[nodiscard]] bool solid_follows(std::uint32_t slot) const {
    return edges_.leads_up(slot) == (result_.kept[slot / 3] == Kept::turned_round);
  }

  void join_around(const std::vector<std::uint32_t>& at) {
    result_.closed &= at.size() % 2 == 0;
    if (at.size() > 2) ++result_.singular_edges;
    const bool through_solid = touching_ == Touching::separate;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const std::uint32_t s = at[i], next = at[i + 1 < at.size() ? i + 1 : 0];
      result_.closed &= solid_follows(s) != solid_follows(next);
      if (at.size() > 2) result_.singular[s] = 1;
      if (solid_follows(s) != through_solid) continue;
      result_.mate[s] = next;
      result_.mate[next] = s;
    }
  }

  const CleanSoup& soup_;
  const Sheets& sheets_;
  const SheetEdges& edges_;
  const Stacks& stacks_;
  const Chambers& chambers_;
  const std::vector<char>& solid_;
  const Touching touching_;
  KeptFacets result_;
};

}  // namespace

KeptFacets keep_facets(const CleanSoup& soup, const Sheets& sheets, const SheetEdges& edges,
                       const Stacks& stacks, const Chambers& chambers,
                       const std::vector<char>& solid, Touching touching) {
  return FacetKeeper(soup, sheets, edges, stacks, chambers, solid, touching).run();
}

}  // namespace meshrepair::internal
