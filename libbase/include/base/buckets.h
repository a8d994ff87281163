// SPDX-License-Identifier: MIT
// Entries by buckets, as in the first pass of a radix sort.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <base/parallel.h>
#include <base/trivial_vector.h>

namespace meshrepair {

// Each bucket has its entries in the order of the items that gave them. Made on several threads,
// linear; some hundreds of buckets can be written to side by side.
template <class Entry>
class Buckets {
 public:
  // give(i, put) calls put(bucket, entry) for each entry of item i, the same ones whenever it is
  // asked. Less than 2^32 entries.
  template <class Give>
  Buckets(std::size_t items, std::size_t buckets, const Give& give) {
    const std::size_t tasks = tasks_of(items, kItemsPerTask);
    std::vector<std::uint32_t> places(tasks * buckets, 0);
    const auto for_each_task = [&](const auto& put) {
      parallel_tasks(
          items, kItemsPerTask, [&](std::size_t task, std::size_t first, std::size_t last) {
            std::uint32_t* const place = places.data() + task * buckets;
            for (std::size_t i = first; i < last; ++i) {
              give(i, [&](std::size_t bucket, const Entry& entry) { put(place[bucket], entry); });
            }
          });
    };
    for_each_task([](std::uint32_t& count, const Entry&) { ++count; });
    std::uint32_t sum = 0;
    first_.reserve(buckets + 1);
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
      first_.push_back(sum);
      for (std::size_t task = 0; task < tasks; ++task) {
        std::uint32_t& place = places[task * buckets + bucket];
        sum += std::exchange(place, sum);
      }
    }
    first_.push_back(sum);
    entries_.resize_for_overwrite(sum);
    for_each_task([&](std::uint32_t& place, const Entry& entry) { entries_[place++] = entry; });
  }

  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }
  // How many entries the buckets before this one have; size(): all of them.
  [[nodiscard]] std::uint32_t first(std::size_t bucket) const { return first_[bucket]; }
  [[nodiscard]] std::span<Entry> operator[](std::size_t bucket) {
    return {entries_.begin() + first_[bucket], entries_.begin() + first_[bucket + 1]};
  }
  [[nodiscard]] std::span<const Entry> operator[](std::size_t bucket) const {
    return {entries_.begin() + first_[bucket], entries_.begin() + first_[bucket + 1]};
  }

 private:
  static constexpr std::size_t kItemsPerTask = 65536;

  TrivialVector<Entry> entries_;
  std::vector<std::uint32_t> first_;
};

}  // namespace meshrepair
