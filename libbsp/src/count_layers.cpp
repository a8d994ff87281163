// SPDX-License-Identifier: MIT
#include "count_layers.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>
#include <vector>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {
namespace {

// After as many changes of single triangles nothing is left to gain, or hardly.
constexpr int kRounds = 8;

// Of an edge that copied triangles have: how much more often it is passed up than down.
struct Balance {
  std::uint32_t first;  // of the copied triangles
  std::int64_t as_one = 0;
  std::int64_t as_layers = 0;
  std::int64_t now = 0;
};

class LayerCounter {
 public:
  LayerCounter(const CleanSoup& soup, std::span<const CopiedTriangle> copied)
      : copied_(copied),
        place_(soup.triangles.size(), kNone),
        sets_(copied.size()),
        passes_(copied.size()),
        counts_(copied.size(), 0) {
    triangles_.reserve(soup.triangles.size());
    for (const Triangle& t : soup.triangles) {
      triangles_.push_back({t.corners[0].value, t.corners[1].value, t.corners[2].value});
    }
    for (std::uint32_t i = 0; i < copied.size(); ++i) place_[copied[i].triangle.index()] = i;
  }

  // Of each copied triangle, whether its layers count.
  std::vector<char> run() {
    balance_edges();
    choose_for_sets();
    for (int round = 0; round < kRounds && change_single(); ++round) {
    }
    return std::move(counts_);
  }

 private:
  struct Pass {
    std::uint32_t edge = 0;
    int way = 0;  // 1 up, -1 down
  };

  void balance_edges() {
    const EdgeTable table(triangles_);
    table.for_each_edge([&](std::span<const std::uint32_t> sides) {
      const auto edge = static_cast<std::uint32_t>(edges_.size());
      Balance balance{kNone};
      for (const std::uint32_t s : sides) {
        const int way = side_start(triangles_, s) < side_start(triangles_, next_side(s)) ? 1 : -1;
        const std::uint32_t i = place_[s / 3];
        balance.as_one += way * (i == kNone ? 1 : copied_[i].facing);
        balance.as_layers += way * (i == kNone ? 1 : copied_[i].layers);
        if (i == kNone) continue;
        passes_[i][s % 3] = {edge, way};
        if (balance.first == kNone) balance.first = i;
        sets_.join(balance.first, i);
      }
      if (balance.first != kNone) edges_.push_back(balance);
    });
  }

  // All that are connected through edges have the same.
  void choose_for_sets() {
    std::vector<std::int64_t> gain(copied_.size(), 0);
    for (const Balance& edge : edges_) {
      gain[sets_.root(edge.first)] += std::abs(edge.as_one) - std::abs(edge.as_layers);
    }
    for (std::uint32_t i = 0; i < copied_.size(); ++i) counts_[i] = gain[sets_.root(i)] > 0 ? 1 : 0;
    for (Balance& edge : edges_) {
      edge.now = counts_[edge.first] != 0 ? edge.as_layers : edge.as_one;
    }
  }

  bool change_single() {
    bool changed = false;
    for (std::size_t i = 0; i < copied_.size(); ++i) {
      const std::int64_t more = std::int64_t{copied_[i].layers} - copied_[i].facing;
      const std::int64_t change = counts_[i] != 0 ? -more : more;
      std::int64_t gain = 0;
      for (const auto& [edge, way] : passes_[i]) {
        gain += std::abs(edges_[edge].now) - std::abs(edges_[edge].now + way * change);
      }
      if (gain <= 0) continue;
      for (const auto& [edge, way] : passes_[i]) edges_[edge].now += way * change;
      counts_[i] = counts_[i] != 0 ? 0 : 1;
      changed = true;
    }
    return changed;
  }

  std::span<const CopiedTriangle> copied_;
  std::vector<IndexTriangle> triangles_;
  std::vector<std::uint32_t> place_;  // of each triangle, in `copied_`
  DisjointSets sets_;
  std::vector<std::array<Pass, 3>> passes_;  // of each copied triangle, its edges
  std::vector<Balance> edges_;               // those of copied triangles
  std::vector<char> counts_;
};

}  // namespace

void count_layers(CleanSoup& soup, std::span<const CopiedTriangle> copied) {
  const bool any_choice = std::any_of(copied.begin(), copied.end(),
                                      [](const CopiedTriangle& t) { return t.facing != t.layers; });
  const std::vector<char> counts =
      any_choice ? LayerCounter(soup, copied).run() : std::vector<char>(copied.size(), 0);
  for (std::size_t i = 0; i < copied.size(); ++i) {
    Triangle& triangle = soup.triangles[copied[i].triangle];
    const std::int32_t all = counts[i] != 0 ? copied[i].layers : copied[i].facing;
    triangle.winding *= std::clamp(all, -1, 1);
    if (all < 0) std::swap(triangle.corners[1], triangle.corners[2]);
    triangle.layers = std::max(1, std::abs(all));
  }
}

}  // namespace meshrepair::internal
