// SPDX-License-Identifier: MIT
// Where new items already are in a long list.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/internal/hash_index.h>
#include <base/parallel.h>

namespace meshrepair {

// A list that grows: `Keys` says what is equal. Items of the list are numbered from 0, new ones go
// on behind them.
//
// For each new item the first one that is equal to it, by keys.same(i, j), in the list or among the
// new ones. keys.hash_of(i) is the same for equal items, and its bits are mixed. Only new items are
// in a table, and the list is read in order: this suits a few new items, and a list that does not
// fit in memory. Linear; the work is for several threads.
template <class Keys>
std::vector<std::uint32_t> first_known(std::uint32_t known, std::uint32_t fresh, const Keys& keys) {
  constexpr std::size_t kItemsPerTask = std::size_t{1} << 16;
  internal::HashIndex index(fresh);
  std::vector<std::uint32_t> first(fresh);
  for (std::uint32_t i = 0; i < fresh; ++i) {
    const auto is_same = [&](std::uint32_t other) { return keys.same(other, known + i); };
    first[i] = index.find_or_insert(keys.hash_of(known + i), known + i, is_same);
  }
  // In the list, of the first of equal new items.
  std::vector<std::atomic<std::uint32_t>> place(fresh);
  for (std::uint32_t i = 0; i < fresh; ++i) place[i].store(first[i], std::memory_order_relaxed);
  parallel_tasks(known, kItemsPerTask, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (auto item = static_cast<std::uint32_t>(begin); item < end; ++item) {
      const std::uint32_t found = index.find(
          keys.hash_of(item), [&](std::uint32_t other) { return keys.same(item, other); });
      if (found == internal::HashIndex::kNone) continue;
      std::atomic<std::uint32_t>& least = place[found - known];
      std::uint32_t before = least.load(std::memory_order_relaxed);
      while (item < before &&
             !least.compare_exchange_weak(before, item, std::memory_order_relaxed)) {
      }
    }
  });
  for (std::uint32_t& item : first) item = place[item - known];
  return first;
}

// How many of the new items are not in the list yet, equal ones counted once.
[[nodiscard]] inline std::size_t count_fresh(std::span<const std::uint32_t> first,
                                             std::uint32_t known) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) count += first[i] == known + i ? 1 : 0;
  return count;
}

}  // namespace meshrepair
