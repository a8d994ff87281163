// SPDX-License-Identifier: MIT
// Union-find over 0 ... n - 1. The lowest member stands for its set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace meshrepair {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  std::uint32_t root(std::uint32_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }

  // Path halving alone keeps this logarithmic; the lowest root wins so that results follow the
  // input's order.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

  [[nodiscard]] std::size_t count() const {
    std::size_t roots = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) roots += parent_[i] == i;
    return roots;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace meshrepair
