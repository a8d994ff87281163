// SPDX-License-Identifier: MIT
// Union-find over 0 ... n - 1 by several threads at once. The lowest member stands for its set, so
// what comes out does not depend on who comes first.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <base/parallel.h>
#include <base/raw_vector.h>

namespace meshrepair {

class SharedSets {
 public:
  explicit SharedSets(std::size_t count) : parent_(count) {
    parallel_tasks(count, kMembersPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) parent_[i] = static_cast<std::uint32_t>(i);
    });
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
    const auto roots = [&](std::size_t first, std::size_t last) {
      std::size_t found = 0;
      for (std::size_t i = first; i < last; ++i) found += parent_[i] == i;
      return found;
    };
    return parallel_reduce(parent_.size(), kMembersPerTask, roots,
                           [](std::size_t& all, std::size_t some) { all += some; });
  }

 private:
  static constexpr std::size_t kMembersPerTask = 65536;

  std::atomic_ref<std::uint32_t> at(std::uint32_t member) {
    return std::atomic_ref<std::uint32_t>(parent_[member]);
  }
  std::uint32_t load(std::uint32_t member) { return at(member).load(std::memory_order_relaxed); }

  RawVector<std::uint32_t> parent_;
};

}  // namespace meshrepair
