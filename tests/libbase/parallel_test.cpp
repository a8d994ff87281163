// SPDX-License-Identifier: MIT
// These hold in any build and for any number of threads.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gmock/gmock.h>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/parallel.h>

namespace meshrepair {
namespace {

using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(ParallelFor, DoesEachItemOnce) {
  for (const std::size_t count : {0u, 1u, 2u, 1000u, 100000u}) {
    std::vector<int> done(count, 0);
    parallel_for(count, [&](std::size_t i) { ++done[i]; });
    EXPECT_THAT(done, ::testing::Each(1)) << count;
  }
}

TEST(ParallelFor, PassesOnWhatABodyThrows) {
  const auto stop = [](std::size_t i) {
    if (i == 500) throw Cancelled();
  };
  EXPECT_THROW(parallel_for(1000, stop), Cancelled);
}

TEST(ParallelFor, BeginsNothingMoreOnceABodyHasThrown) {
  std::atomic<std::size_t> begun = 0;
  const auto fail = [&](std::size_t) {
    ++begun;
    throw InputError("one of many");
  };
  EXPECT_THROW(parallel_for(100000, fail), InputError);
  EXPECT_LE(begun, most_threads());
}

// A body goes on after a call of its own, and relies on it.
TEST(ParallelFor, WithinABodyDoesAllEvenWhereAnotherHasThrown) {
  constexpr std::size_t kItems = 2000;
  std::atomic<std::size_t> incomplete = 0;
  const auto work = [&](std::size_t i) {
    std::vector<double> roots(kItems, -1);
    parallel_for(kItems, [&](std::size_t k) {
      for (int step = 0; step < 10; ++step) roots[k] = std::sqrt(roots[k] + 2);
    });
    incomplete += std::count(roots.begin(), roots.end(), -1) > 0;
    if (i % 7 == 3) throw Cancelled();
  };
  for (int repetition = 0; repetition < 100; ++repetition) {
    EXPECT_THROW(parallel_for(64, work), Cancelled);
  }
  EXPECT_EQ(incomplete, 0U);
}

TEST(ParallelTasks, AreOfOneSizeButTheLast) {
  const auto ranges_of = [](std::size_t count, std::size_t per_task) {
    Ranges ranges(tasks_of(count, per_task));
    parallel_tasks(count, per_task, [&](std::size_t task, std::size_t first, std::size_t last) {
      ranges[task] = {first, last};
    });
    return ranges;
  };
  EXPECT_EQ(ranges_of(0, 4), Ranges());
  EXPECT_EQ(ranges_of(3, 4), (Ranges{{0, 3}}));
  EXPECT_EQ(ranges_of(8, 4), (Ranges{{0, 4}, {4, 8}}));
  EXPECT_EQ(ranges_of(9, 4), (Ranges{{0, 4}, {4, 8}, {8, 9}}));
}

TEST(ParallelTasks, DoNotOverflow) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(tasks_of(kMost, kMost), 1U);
  EXPECT_EQ(tasks_of(kMost, kMost - 1), 2U);
  std::size_t end = 0;
  parallel_tasks(kMost, kMost, [&](std::size_t, std::size_t, std::size_t last) { end = last; });
  EXPECT_EQ(end, kMost);
}

TEST(ParallelReduce, JoinsFromTheFirstToTheLast) {
  const auto text = [](std::size_t first, std::size_t last) {
    return std::to_string(first) + "-" + std::to_string(last) + " ";
  };
  const auto append = [](std::string& all, const std::string& part) { all += part; };
  EXPECT_EQ(parallel_reduce(10, 4, text, append), "0-4 4-8 8-10 ");
  EXPECT_EQ(parallel_reduce(0, 4, text, append), "");
}

TEST(ParallelReduce, RoundsTheSameForAnyThreads) {
  const auto sum_of = [] {
    return parallel_reduce(
        100000, 100,
        [](std::size_t first, std::size_t last) {
          float sum = 0;
          for (std::size_t i = first; i < last; ++i) sum += 1 / static_cast<float>(i + 1);
          return sum;
        },
        [](float& all, float part) { all += part; });
  };
  const float sum = sum_of();
  const ThreadLimit one(1);
  EXPECT_EQ(sum_of(), sum);
}

TEST(ParallelReduce, PassesOnWhatABodyThrows) {
  const auto fail = [](std::size_t, std::size_t) -> int { throw Cancelled(); };
  EXPECT_THROW(parallel_reduce(1000, 10, fail, [](int&, int) {}), Cancelled);
}

std::size_t count_by_halves(std::size_t count) {
  if (count < 2) return count;
  std::size_t left = 0, right = 0;
  parallel_invoke([&] { left = count_by_halves(count / 2); },
                  [&] { right = count_by_halves(count - count / 2); });
  return left + right;
}

TEST(ParallelInvoke, RunsNestedPairs) { EXPECT_EQ(count_by_halves(10000), 10000U); }

TEST(ParallelInvoke, PassesOnWhatOneThrows) {
  const auto fail = [] { throw Cancelled(); };
  const auto rest = [] {};
  EXPECT_THROW(parallel_invoke(fail, rest), Cancelled);
  EXPECT_THROW(parallel_invoke(rest, fail), Cancelled);
}

TEST(ParallelSort, LeavesEqualItemsInTheirOrder) {
  std::mt19937 random(1);
  for (const std::size_t count : {0u, 1u, 16384u, 16385u, 200000u}) {
    std::vector<std::pair<std::uint32_t, std::size_t>> items;
    for (std::size_t i = 0; i < count; ++i) items.emplace_back(random() % 1000, i);
    const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
    parallel_sort(items.begin(), items.end(), less);
    EXPECT_TRUE(std::is_sorted(items.begin(), items.end())) << count;
  }
}

TEST(ThreadLimit, OfOneLeavesAllToTheCaller) {
  const ThreadLimit one(1);
  EXPECT_EQ(most_threads(), 1U);
  std::atomic<std::size_t> elsewhere = 0;
  const auto caller = std::this_thread::get_id();
  parallel_for(10000, [&](std::size_t) { elsewhere += std::this_thread::get_id() != caller; });
  EXPECT_EQ(elsewhere, 0U);
}

TEST(ThreadLimit, HoldsWhileItLivesAndTheLowestCounts) {
  const std::size_t before = most_threads();
  {
    const ThreadLimit none(0);
    EXPECT_EQ(most_threads(), before);
    const ThreadLimit one(1);
    const ThreadLimit two(2);
    EXPECT_EQ(most_threads(), 1U);
  }
  EXPECT_EQ(most_threads(), before);
}

}  // namespace
}  // namespace meshrepair
