// SPDX-License-Identifier: MIT
// Which items of a list are equal.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/buckets.h>
#include <base/internal/hash_index.h>
#include <base/parallel.h>

namespace meshrepair {

// For each item 0 ... count - 1 the first one that is equal to it, by same(i, j). `hash_of(i)` is
// the same for equal items, and its bits are mixed. Linear; the work is for several threads.
template <class HashOf, class Same>
std::vector<std::uint32_t> first_equal(std::size_t count, const HashOf& hash_of, const Same& same) {
  constexpr std::size_t kItemsPerBucket = 8192;  // their table stays in the nearest caches
  constexpr std::size_t kMostBuckets = 511;
  struct Entry {
    std::uint32_t item;
    std::uint32_t hash;
  };
  const auto bits = std::bit_width(std::min(count / kItemsPerBucket, kMostBuckets));
  const Buckets<Entry> buckets(count, std::size_t{1} << bits, [&](std::size_t i, const auto& put) {
    const std::uint64_t hash = hash_of(i);
    put(bits == 0 ? 0 : static_cast<std::size_t>(hash >> (64 - bits)),
        {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(hash ^ (hash >> 32))});
  });
  std::vector<std::uint32_t> first(count);
  parallel_for(buckets.size(), [&](std::size_t bucket) {
    const auto entries = buckets[bucket];
    internal::HashIndex index(entries.size());
    for (std::uint32_t e = 0; e < entries.size(); ++e) {
      const Entry& entry = entries[e];
      const std::uint32_t found = index.find_or_insert(entry.hash, e, [&](std::uint32_t other) {
        return entries[other].hash == entry.hash && same(entries[other].item, entry.item);
      });
      first[entry.item] = entries[found].item;
    }
  });
  return first;
}

}  // namespace meshrepair
