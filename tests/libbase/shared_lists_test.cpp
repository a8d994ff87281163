// SPDX-License-Identifier: MIT
// Lists that several threads make: what comes out is what one thread would have made.
#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <base/buckets.h>
#include <base/disjoint_sets.h>
#include <base/first_equal.h>
#include <base/raw_vector.h>
#include <base/release.h>
#include <base/shared_sets.h>

#include "each_seed.h"
#include "random_geometry.h"

namespace meshrepair {
namespace {

using testing::Random;

std::uint64_t mixed(std::uint64_t value) { return internal::hash_mix(0, value + 1); }

std::vector<std::uint32_t> random_values(std::size_t count, std::uint32_t below,
                                         std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint32_t> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(
        static_cast<std::uint32_t>(random.integer(0, static_cast<std::int32_t>(below) - 1)));
  }
  return values;
}

TEST(FirstEqual, LowestIndexIsFoundWhateverTheSizeOfTheList) {
  for (const std::size_t count : {0u, 1u, 2u, 100u, 8191u, 8192u, 16384u, 200'000u}) {
    for (const std::uint32_t below : {1u, 7u, 50'000u, 1u << 30}) {
      SCOPED_TRACE(::testing::Message() << count << " of " << below);
      const std::vector<std::uint32_t> values = random_values(count, below, count + below);
      const std::vector<std::uint32_t> first = first_equal(
          count, [&](std::size_t i) { return mixed(values[i]); },
          [&](std::size_t i, std::size_t j) { return values[i] == values[j]; });
      std::vector<std::uint32_t> order(count);
      for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
      std::stable_sort(order.begin(), order.end(),
                       [&](std::uint32_t i, std::uint32_t j) { return values[i] < values[j]; });
      std::uint32_t lowest = 0;
      ASSERT_EQ(first.size(), count);
      for (std::size_t k = 0; k < count; ++k) {
        if (k == 0 || values[order[k]] != values[order[k - 1]]) lowest = order[k];
        ASSERT_EQ(first[order[k]], lowest);
      }
    }
  }
}

TEST(FirstEqual, TellsItemsOfOneHashApart) {
  const std::vector<std::uint32_t> values = random_values(3'000, 40, 1);
  const std::vector<std::uint32_t> first = first_equal(
      values.size(), [](std::size_t) { return std::uint64_t{0x123456789abcdef}; },
      [&](std::size_t i, std::size_t j) { return values[i] == values[j]; });
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto found = std::find(values.begin(), values.end(), values[i]);
    EXPECT_EQ(first[i], static_cast<std::uint32_t>(found - values.begin()));
  }
}

TEST(Buckets, KeepTheOrderOfItemsThatGiveNoneOrSeveral) {
  const std::vector<std::uint32_t> values = random_values(300'000, 37, 2);
  using Entry = std::uint32_t;
  const Buckets<Entry> buckets(values.size(), 37, [&](std::size_t i, const auto& put) {
    for (std::uint32_t k = 0; k < values[i] % 3; ++k) {
      put((values[i] + k) % 37, static_cast<Entry>(i));
    }
  });
  std::vector<std::vector<Entry>> wanted(37);
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    for (std::uint32_t k = 0; k < values[i] % 3; ++k) wanted[(values[i] + k) % 37].push_back(i);
  }
  ASSERT_EQ(buckets.size(), 37u);
  std::size_t before = 0;
  for (std::size_t b = 0; b < 37; ++b) {
    EXPECT_EQ(buckets.first(b), before);
    EXPECT_TRUE(
        std::equal(buckets[b].begin(), buckets[b].end(), wanted[b].begin(), wanted[b].end()));
    before += wanted[b].size();
  }
  EXPECT_EQ(buckets.first(37), before);
}

TEST(Buckets, MayBeWithoutItems) {
  const Buckets<int> buckets(0, 4, [](std::size_t, const auto&) {});
  EXPECT_EQ(buckets.size(), 4u);
  EXPECT_TRUE(buckets[3].empty());
  EXPECT_EQ(Buckets<int>(0, 0, [](std::size_t, const auto&) {}).size(), 0u);
}

TEST(SharedSets, SetsAreThoseOfOneThread) {
  for_each_seed(8, [&](std::uint64_t seed) {
    const std::uint32_t count = 20'000;
    // Near ones mostly, so that threads meet in long chains.
    const std::vector<std::uint32_t> from = random_values(count * 3 / 4, count, seed);
    const std::vector<std::uint32_t> steps = random_values(from.size(), 9, seed + 100);
    const auto to = [&](std::size_t i) { return (from[i] + steps[i]) % count; };
    DisjointSets alone(count);
    for (std::size_t i = 0; i < from.size(); ++i) alone.join(from[i], to(i));
    SharedSets shared(count);
    parallel_for(from.size(), [&](std::size_t i) { shared.join(from[i], to(i)); });
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(shared.root(i), alone.root(i));
    EXPECT_EQ(shared.count(), alone.count());
  });
}

TEST(Release, LeavesNoRoom) {
  std::vector<int> numbers(1'000, 1);
  release(numbers);
  EXPECT_TRUE(numbers.empty());
  EXPECT_EQ(numbers.capacity(), 0u);
}

TEST(RawVector, KeepsWhatItHasWhenItGrows) {
  RawVector<int> numbers(3, 7);
  numbers.resize(1'000);
  EXPECT_EQ(numbers.size(), 1'000u);
  EXPECT_TRUE(std::all_of(numbers.begin(), numbers.begin() + 3, [](int n) { return n == 7; }));
  numbers.push_back(5);
  EXPECT_EQ(numbers.back(), 5);
}

}  // namespace
}  // namespace meshrepair
