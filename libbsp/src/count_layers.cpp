#include "count_layers.h"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include <bsp/disjoint_sets.h>
#include <bsp/edge_table.h>
#include <bsp/ids.h>

namespace meshrepair::internal {
namespace {

// By how much edges are passed more often one way than the other.
struct Imbalance {
  std::int64_t as_one = 0;
  std::int64_t as_layers = 0;
};

class LayerCounter {
 public:
  LayerCounter(const CleanSoup& soup, std::span<const CopiedTriangle> copied)
      : copied_(copied), place_(soup.triangles.size(), kNone), sets_(copied.size()) {
    triangles_.reserve(soup.triangles.size());
    for (const Triangle& t : soup.triangles) {
      triangles_.push_back({t.corners[0].value, t.corners[1].value, t.corners[2].value});
    }
    for (std::uint32_t i = 0; i < copied.size(); ++i) place_[copied[i].triangle.index()] = i;
  }

  // Of each copied triangle, whether its layers count.
  std::vector<char> run() {
    const EdgeTable table(triangles_);
    std::vector<std::pair<std::uint32_t, Imbalance>> edges;
    table.for_each_edge([&](std::span<const std::uint32_t> sides) {
      std::uint32_t first = kNone;
      for (const std::uint32_t s : sides) {
        const std::uint32_t i = place_[s / 3];
        if (i == kNone) continue;
        if (first == kNone) first = i;
        sets_.join(first, i);
      }
      if (first != kNone) edges.emplace_back(first, imbalance_of(sides));
    });
    std::vector<Imbalance> sums(copied_.size());
    for (const auto& [i, imbalance] : edges) {
      Imbalance& sum = sums[sets_.root(i)];
      sum.as_one += imbalance.as_one;
      sum.as_layers += imbalance.as_layers;
    }
    std::vector<char> counts;
    counts.reserve(copied_.size());
    for (std::uint32_t i = 0; i < copied_.size(); ++i) {
      const Imbalance& sum = sums[sets_.root(i)];
      counts.push_back(sum.as_layers < sum.as_one ? 1 : 0);
    }
    return counts;
  }

 private:
  [[nodiscard]] Imbalance imbalance_of(std::span<const std::uint32_t> sides) const {
    Imbalance sum;
    for (const std::uint32_t s : sides) {
      const bool up = side_start(triangles_, s) < side_start(triangles_, next_side(s));
      const std::uint32_t i = place_[s / 3];
      const std::int64_t as_one = i == kNone ? 1 : copied_[i].facing;
      const std::int64_t as_layers = i == kNone ? 1 : copied_[i].layers;
      sum.as_one += up ? as_one : -as_one;
      sum.as_layers += up ? as_layers : -as_layers;
    }
    return {std::abs(sum.as_one), std::abs(sum.as_layers)};
  }

  std::span<const CopiedTriangle> copied_;
  std::vector<IndexTriangle> triangles_;
  std::vector<std::uint32_t> place_;  // of each triangle, in `copied_`
  DisjointSets sets_;
};

std::int32_t sign_of(std::int32_t x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

}  // namespace

void count_layers(CleanSoup& soup, std::span<const CopiedTriangle> copied) {
  if (copied.empty()) return;
  const std::vector<char> counts = LayerCounter(soup, copied).run();
  for (std::size_t i = 0; i < copied.size(); ++i) {
    Triangle& triangle = soup.triangles[copied[i].triangle];
    const std::int32_t all = counts[i] != 0 ? copied[i].layers : copied[i].facing;
    triangle.winding *= sign_of(all);
    triangle.layers = std::max(1, std::abs(all));
  }
}

}  // namespace meshrepair::internal
