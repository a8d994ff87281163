// SPDX-License-Identifier: MIT
// What comparisons of triangles have found, and how it is put together.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <check/internal/triangle_pair.h>
#include <check/self_intersections.h>

namespace meshrepair::internal {

using Pair = std::array<std::uint32_t, 2>;

// What one task has found: counts of all, and the lowest `most` pairs.
class Findings {
 public:
  explicit Findings(std::size_t most) : most_(most) {}

  void add(std::uint32_t a, std::uint32_t b, Meeting meeting) {
    ++counts_[static_cast<std::size_t>(meeting)];
    pairs_.push_back({std::min(a, b), std::max(a, b)});
    if (pairs_.size() > most_ && pairs_.size() - most_ >= most_ + 64) keep_lowest();
  }

  [[nodiscard]] std::size_t count() const {
    return std::accumulate(counts_.begin(), counts_.end(), std::size_t{0});
  }

  void add_to(SelfIntersections& result) const {
    result.pairs.insert(result.pairs.end(), pairs_.begin(), pairs_.end());
    result.crossing += counts_[static_cast<std::size_t>(Meeting::crossing)];
    result.touching += counts_[static_cast<std::size_t>(Meeting::touching)];
    result.coplanar += counts_[static_cast<std::size_t>(Meeting::coplanar)];
  }

 private:
  void keep_lowest() {
    const auto middle = pairs_.begin() + static_cast<std::ptrdiff_t>(most_);
    std::nth_element(pairs_.begin(), middle, pairs_.end());
    pairs_.resize(most_);
  }

  std::size_t most_;
  std::vector<Pair> pairs_;
  std::array<std::size_t, 4> counts_{};
};

inline SelfIntersections gather(const std::vector<Findings>& tasks, std::size_t most) {
  SelfIntersections result;
  for (const Findings& findings : tasks) findings.add_to(result);
  std::sort(result.pairs.begin(), result.pairs.end());
  if (result.pairs.size() > most) result.pairs.resize(most);
  result.count = result.crossing + result.touching + result.coplanar;
  return result;
}

}  // namespace meshrepair::internal
