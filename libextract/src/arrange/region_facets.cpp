// SPDX-License-Identifier: MIT
#include "region_facets.h"

#include <base/ids.h>

namespace meshrepair::internal {
namespace {

class RegionFacetKeeper {
 public:
  RegionFacetKeeper(const CleanSoup& soup, const Sheets& sheets, const SheetEdges& edges,
                    const Stacks& stacks, const Chambers& chambers,
                    std::span<const std::uint32_t> region)
      : soup_(soup),
        sheets_(sheets),
        edges_(edges),
        stacks_(stacks),
        chambers_(chambers),
        region_(region) {}

  RegionFacets run() {
    result_.kept.is_between_regions = true;
    result_.kept.kept.assign(sheets_.size(), Kept::no);
    result_.regions.resize(sheets_.size());
    for (std::uint32_t f = 0; f < sheets_.size(); ++f) {
      if (!stacks_.contains(f)) keep(f, front(f), behind(f));
    }
    stacks_.for_each([&](std::span<const std::uint32_t> stack) { keep_one_of(stack); });
    join();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::uint32_t front(std::uint32_t f) const { return region_[chambers_.front[f]]; }
  [[nodiscard]] std::uint32_t behind(std::uint32_t f) const { return region_[chambers_.behind[f]]; }
  [[nodiscard]] bool faces_along(std::uint32_t f) const {
    return corner_side(soup_, sheets_.triangle[f]) > 0;
  }

  void keep(std::uint32_t f, std::uint32_t front, std::uint32_t behind) {
    if (front == behind) return;
    const bool turned = front > behind;
    result_.kept.kept[f] = turned ? Kept::turned_round : Kept::as_turned;
    result_.regions[f] = {turned ? behind : front, turned ? front : behind};
  }

  // The pieces of the first triangle stand for all.
  void keep_one_of(std::span<const std::uint32_t> stack) {
    const std::uint32_t lowest = stack.front(), highest = stack.back();
    const std::uint32_t below = faces_along(lowest) ? behind(lowest) : front(lowest);
    const std::uint32_t above = faces_along(highest) ? front(highest) : behind(highest);
    for (const std::uint32_t f : stack) {
      if (sheets_.triangle[f] != sheets_.triangle[lowest]) break;
      const bool along = faces_along(f);
      keep(f, along ? above : below, along ? below : above);
    }
  }

  void join() {
    KeptFacets& kept = result_.kept;
    const auto is_kept = [&](std::uint32_t slot) { return kept.kept[slot / 3] != Kept::no; };
    kept.mate.assign(3 * sheets_.size(), kNone);
    kept.singular.assign(3 * sheets_.size(), 0);
    for (std::uint32_t s = 0; s < 3 * sheets_.size(); ++s) {
      if (sheets_.across[s] != kNone && is_kept(s)) kept.mate[s] = sheets_.across[s];
    }
    std::vector<std::uint32_t> at;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      at.clear();
      for (const std::uint32_t s : edges_.slots(e)) {
        if (is_kept(s)) at.push_back(s);
      }
      for (std::size_t i = 0; i < at.size(); ++i) {
        kept.mate[at[i]] = at[i + 1 < at.size() ? i + 1 : 0];
        kept.singular[at[i]] = at.size() == 2 ? 0 : 1;
      }
    }
  }

  const CleanSoup& soup_;
  const Sheets& sheets_;
  const SheetEdges& edges_;
  const Stacks& stacks_;
  const Chambers& chambers_;
  std::span<const std::uint32_t> region_;
  RegionFacets result_;
};

}  // namespace

RegionFacets keep_facets_between(const CleanSoup& soup, const Sheets& sheets,
                                 const SheetEdges& edges, const Stacks& stacks,
                                 const Chambers& chambers, std::span<const std::uint32_t> region) {
  return RegionFacetKeeper(soup, sheets, edges, stacks, chambers, region).run();
}

}  // namespace meshrepair::internal
