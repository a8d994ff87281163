// SPDX-License-Identifier: MIT
#include "sheet_regions.h"

#include <algorithm>
#include <array>

#include <base/ids.h>
#include <base/parallel.h>
#include <base/shared_sets.h>
#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

// What is known of a point from the edges of outlines that end there.
struct Outline {
  std::uint8_t count = 0;  // up to 3
  std::array<std::uint32_t, 2> slot = {kNone, kNone};
};

class SheetMerger {
 public:
  SheetMerger(const CutSet& cut, const ArrangedPoints& points, const Sheets& sheets,
              const SheetEdges& edges, const KeptFacets& kept, const MergeOptions& options)
      : cut_(cut),
        points_(points),
        sheets_(sheets),
        edges_(edges),
        kept_(kept),
        options_(options),
        joined_(sheets.size()) {}

  SheetRegions run() {
    result_.dissolved.assign(3 * sheets_.size(), 0);
    for_each(3 * sheets_.size(), [&](std::uint32_t s) {
      if (kept_.mate[s] != kNone && kept_.mate[s] > s && sheets_.across[s] != kNone) dissolve(s);
    });
    dissolve_edges(
        [&](std::uint32_t s, std::uint32_t t) { return triangle_of(s) == triangle_of(t); });
    if (options_.merges_triangles) merge_triangles();
    number();
    find_needed();
    return std::move(result_);
  }

 private:
  // visit(i) for each i below `count`, on several threads.
  template <class Visit>
  static void for_each(std::size_t count, const Visit& visit) {
    constexpr std::size_t kVisitsPerTask = 16384;
    parallel_tasks(count, kVisitsPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) visit(static_cast<std::uint32_t>(i));
    });
  }

  [[nodiscard]] std::uint32_t triangle_of(std::uint32_t s) const { return sheets_.triangle[s / 3]; }
  [[nodiscard]] PlaneId plane_of(std::uint32_t s) const {
    return cut_.soup().triangles[TriangleId(triangle_of(s))].plane;
  }
  [[nodiscard]] bool is_cut(std::uint32_t s) const {
    return cut_.number_of(triangle_of(s)) != kNone;
  }
  [[nodiscard]] bool is_broken(std::uint32_t s) const { return broken_[triangle_of(s)] != 0; }

  void dissolve(std::uint32_t s) {
    result_.dissolved[s] = result_.dissolved[kept_.mate[s]] = 1;
    joined_.join(s / 3, kept_.mate[s] / 3);
  }

  void merge_triangles() {
    find_broken();
    dissolve_edges([&](std::uint32_t s, std::uint32_t t) {
      return plane_of(s) == plane_of(t) && is_broken(s) && is_broken(t);
    });
  }

  // Only where nothing but two facets is kept, turned alike.
  template <class BelongTogether>
  void dissolve_edges(BelongTogether belong_together) {
    for_each(edges_.size(), [&](std::uint32_t e) {
      for (const std::uint32_t s : edges_.slots(e)) {
        const std::uint32_t mate = kept_.mate[s];
        if (mate == kNone || mate < s || kept_.singular[s] != 0 || !is_cut(s)) continue;
        if (result_.dissolved[s] == 0 && is_cut(mate) && belong_together(s, mate) &&
            lie_apart(s, mate)) {
          dissolve(s);
        }
      }
    });
  }

  // Two facets in one plane, but not folded onto each other.
  [[nodiscard]] bool lie_apart(std::uint32_t s, std::uint32_t t) const {
    return faces(s) == faces(t);
  }

  // Which way the solid lies, along the plane's normal.
  [[nodiscard]] int faces(std::uint32_t s) const {
    const int side = corner_side(cut_.soup(), triangle_of(s));
    return kept_.kept[s / 3] == Kept::as_turned ? side : -side;
  }

  // Triangles of which not all is one region.
  void find_broken() {
    broken_.assign(sheets_.first.size() - 1, 0);
    for_each(broken_.size(), [&](std::uint32_t t) {
      const std::uint32_t first = sheets_.first[t];
      for (std::uint32_t f = first; f < sheets_.first[t + 1]; ++f) {
        if (kept_.kept[f] == Kept::no || joined_.root(f) != joined_.root(first)) broken_[t] = 1;
      }
    });
  }

  void number() {
    result_.region.resize(sheets_.size());
    for_each(sheets_.size(), [&](std::uint32_t f) {
      result_.region[f] = kept_.kept[f] == Kept::no ? kNone : joined_.root(f);
    });
  }

  void find_needed() {
    outlines_.resize(points_.size());
    result_.needed.assign(points_.size(), 0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      for (const std::uint32_t s : edges_.slots(e)) {
        if (kept_.mate[s] == kNone || result_.dissolved[s] != 0) continue;
        look_at(s);
        break;  // all slots of the edge have the same ends
      }
      for (const std::uint32_t s : edges_.slots(e)) {
        const bool touches = kept_.singular[s] != 0 && !options_.releases_touching;
        if (kept_.mate[s] != kNone && (touches || !is_cut(s))) need_ends_of(s);
      }
    }
    for_each(outlines_.size(), [&](std::uint32_t p) {
      const Outline& outline = outlines_[p];
      if (outline.count > 2 || (outline.count == 2 && !goes_straight_on(p, outline))) {
        result_.needed[p] = 1;
      }
    });
  }

  void look_at(std::uint32_t s) {
    for (const std::uint32_t end : {s, next_side(s)}) {
      Outline& outline = outlines_[sheets_.corners[end / 3][end % 3]];
      if (outline.count < 2) outline.slot[outline.count] = s;
      if (outline.count < 3) ++outline.count;
    }
  }

  void need_ends_of(std::uint32_t s) {
    result_.needed[side_start(sheets_.corners, s)] = 1;
    result_.needed[side_start(sheets_.corners, next_side(s))] = 1;
  }

  // Both edges are in the plane of either facet: two regions share both.
  [[nodiscard]] bool goes_straight_on(std::uint32_t p, const Outline& outline) const {
    if (!is_cut(outline.slot[0]) || !is_cut(outline.slot[1])) return false;
    const auto other_end = [&](std::uint32_t s) {
      const std::uint32_t start = side_start(sheets_.corners, s);
      return start != p ? start : side_start(sheets_.corners, next_side(s));
    };
    const PlaneId plane = cut_.plane(cut_.number_of(triangle_of(outline.slot[0])));
    return turn(points_.at(other_end(outline.slot[0])), points_.at(p),
                points_.at(other_end(outline.slot[1])), plane, cut_.planes()) == 0;
  }

  const CutSet& cut_;
  const ArrangedPoints& points_;
  const Sheets& sheets_;
  const SheetEdges& edges_;
  const KeptFacets& kept_;
  const MergeOptions options_;
  SharedSets joined_;
  std::vector<char> broken_;  // of each triangle of the soup
  std::vector<Outline> outlines_;
  SheetRegions result_;
};

}  // namespace

SheetRegions merge_sheets(const CutSet& cut, const ArrangedPoints& points, const Sheets& sheets,
                          const SheetEdges& edges, const KeptFacets& kept,
                          const MergeOptions& options) {
  return SheetMerger(cut, points, sheets, edges, kept, options).run();
}

}  // namespace meshrepair::internal
