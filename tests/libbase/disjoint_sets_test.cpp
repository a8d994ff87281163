// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <base/disjoint_sets.h>

#include "each_seed.h"
#include "random_geometry.h"

namespace meshrepair {
namespace {

using testing::Random;

TEST(DisjointSets, EachMemberStartsAlone) {
  DisjointSets sets(5);
  EXPECT_EQ(sets.count(), 5u);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(sets.root(i), i);
  EXPECT_EQ(DisjointSets(0).count(), 0u);
}

TEST(DisjointSets, LowestMemberStandsForItsSetWhateverTheOrderOfJoins) {
  for_each_seed(50, [&](std::uint64_t seed) {
    Random random(seed);
    const std::uint32_t count = 60;
    DisjointSets sets(count);
    std::vector<std::uint32_t> label(count);  // by brute force: the lowest member
    for (std::uint32_t i = 0; i < count; ++i) label[i] = i;
    for (int join = 0; join < 50; ++join) {
      const auto a = static_cast<std::uint32_t>(random.integer(0, count - 1));
      const auto b = static_cast<std::uint32_t>(random.integer(0, count - 1));
      sets.join(a, b);
      const std::uint32_t low = std::min(label[a], label[b]);
      const std::uint32_t high = std::max(label[a], label[b]);
      std::replace(label.begin(), label.end(), high, low);
      for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(sets.root(i), label[i]);
    }
    std::sort(label.begin(), label.end());
    const auto distinct = std::unique(label.begin(), label.end()) - label.begin();
    EXPECT_EQ(sets.count(), static_cast<std::size_t>(distinct));
  });
}

TEST(DisjointSets, ALongChainIsNoTrouble) {
  const std::uint32_t count = 1000000;
  DisjointSets sets(count);
  for (std::uint32_t i = count - 1; i > 0; --i) sets.join(i, i - 1);
  EXPECT_EQ(sets.count(), 1u);
  for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(sets.root(i), 0u);
}

}  // namespace
}  // namespace meshrepair
