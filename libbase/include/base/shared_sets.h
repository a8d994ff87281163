// SPDX-License-Identifier: MIT
// Union-find over 0 ... n - 1 by several threads at once. The lowest member stands for its set, so
// what comes out does not depend on who comes first.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace meshrepair {

class SharedSets {
 public:
  explicit SharedSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  // While others join, what is returned may have come under a lower one.
  std::uint32_t root(std::uint32_t member) {
    while (true) {
      const std::uint32_t parent = load(member);
      if (parent == member) return member;
      const std::uint32_t above = load(parent);
      // Whatever others write here in between is above, too.
      if (above != parent) at(member).store(above, std::memory_order_relaxed);
      member = above;
    }
  }

  void join(std::uint32_t a, std::uint32_t b) {
    while (true) {
      a = root(a);
      b = root(b);
      if (a == b) return;
      if (a > b) std::swap(a, b);
      std::uint32_t expected = b;
      if (at(b).compare_exchange_strong(expected, a, std::memory_order_relaxed)) return;
    }
  }

  // Once all have joined.
  [[nodiscard]] std::size_t count() const {
    std::size_t roots = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) roots += parent_[i] == i;
    return roots;
  }

 private:
  std::atomic_ref<std::uint32_t> at(std::uint32_t member) {
    return std::atomic_ref<std::uint32_t>(parent_[member]);
  }
  std::uint32_t load(std::uint32_t member) { return at(member).load(std::memory_order_relaxed); }

  std::vector<std::uint32_t> parent_;
};

}  // namespace meshrepair
