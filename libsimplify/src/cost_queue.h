// SPDX-License-Identifier: MIT
// What costs least comes first, to a share of 1/32.
//
// Costs of nearly the same size are in one bucket, in the order in which they came. A heap would
// put them in order, too, which nobody can see, and look all over its memory for it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshrepair::internal {

// Of items with a member `cost`, not below 0, as meshes of unit size have it: the smallest are
// alike.
template <class Item>
class CostQueue {
 public:
  [[nodiscard]] bool empty() const { return count_ == 0; }

  void push(const Item& item) {
    const std::size_t b = bucket_of(item.cost);
    buckets_[b].items.push_back(item);
    filled_[b / 64] |= std::uint64_t{1} << b % 64;
    first_ = std::min(first_, b);
    ++count_;
  }

  // There is one.
  [[nodiscard]] Item pop() {
    Bucket& bucket = buckets_[first_];
    const Item item = bucket.items[bucket.next++];
    --count_;
    if (bucket.next == bucket.items.size()) {
      bucket = {};
      filled_[first_ / 64] &= ~(std::uint64_t{1} << first_ % 64);
      find_first();
    }
    return item;
  }

  // Whether others come before an item of this cost.
  [[nodiscard]] bool has_cheaper(double cost) const {
    return count_ > 0 && first_ < bucket_of(cost);
  }

 private:
  static constexpr int kMantissaBits = 5;
  static constexpr std::size_t kOfOne = std::size_t{1023} << kMantissaBits;
  static constexpr std::size_t kBuckets = std::size_t{256} << kMantissaBits;
  static constexpr std::size_t kSmallest = kOfOne - kBuckets * 3 / 4;

  struct Bucket {
    std::vector<Item> items;
    std::size_t next = 0;  // of those that are still there
  };

  // Numbers that are not negative are in the order of their bits.
  static std::size_t bucket_of(double cost) {
    const std::size_t place = std::bit_cast<std::uint64_t>(cost) >> (52 - kMantissaBits);
    return std::clamp(place, kSmallest, kSmallest + kBuckets - 1) - kSmallest;
  }

  void find_first() {
    if (count_ == 0) {
      first_ = kBuckets - 1;
      return;
    }
    std::size_t word = first_ / 64;
    while (filled_[word] == 0) ++word;
    first_ = 64 * word + static_cast<std::size_t>(std::countr_zero(filled_[word]));
  }

  std::vector<Bucket> buckets_ = std::vector<Bucket>(kBuckets);
  std::array<std::uint64_t, kBuckets / 64> filled_{};  // a bit for each bucket
  std::size_t first_ = kBuckets - 1;                   // that is filled
  std::size_t count_ = 0;
};

}  // namespace meshrepair::internal
