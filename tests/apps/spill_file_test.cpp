// SPDX-License-Identifier: MIT
#include "spill/spill_file.h"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <random>
#include <span>
#include <sys/resource.h>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/internal/system.h>

#include "spill/resident_limit.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMega = std::size_t{1} << 20;

// All numbers of a block are `value` and what follows.
std::span<std::uint64_t> numbers_of(void* block, std::size_t bytes) {
  return {static_cast<std::uint64_t*>(block), bytes / sizeof(std::uint64_t)};
}

void fill(void* block, std::size_t bytes, std::uint64_t value) {
  for (std::uint64_t& number : numbers_of(block, bytes)) number = value++;
}

bool holds(void* block, std::size_t bytes, std::uint64_t value) {
  for (const std::uint64_t number : numbers_of(block, bytes)) {
    if (number != value++) return false;
  }
  return true;
}

class SpillFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "spill_test_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(SpillFileTest, BlocksKeepWhatTheyHold) {
  SpillFile file(folder_, 0);
  struct Held {
    void* block;
    std::size_t bytes;
    std::uint64_t value;
  };
  std::vector<Held> all;
  std::mt19937 random(7);
  for (std::uint64_t turn = 0; turn < 400; ++turn) {
    if (all.size() > 8 || (random() % 3 == 0 && !all.empty())) {
      const std::size_t which = random() % all.size();
      ASSERT_TRUE(holds(all[which].block, all[which].bytes, all[which].value));
      file.give_back(all[which].block);
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(which));
    } else {
      const std::size_t bytes = 8 * (1 + random() % (kMega / 4));
      void* const block = file.take(bytes);
      ASSERT_NE(block, nullptr);
      EXPECT_TRUE(file.owns(block));
      EXPECT_GE(file.size_of(block), bytes);
      all.push_back({block, bytes, turn << 32});
      fill(block, bytes, turn << 32);
    }
    file.let_go(kMega);
  }
  for (const Held& held : all) {
    EXPECT_TRUE(holds(held.block, held.bytes, held.value));
    file.give_back(held.block);
  }
  EXPECT_EQ(file.extent(), 0u);
}

TEST_F(SpillFileTest, WhatIsLetGoOfIsNotInMemory) {
  constexpr std::size_t kBytes = 64 * kMega;
  SpillFile file(folder_, 0);
  void* const block = file.take(kBytes);
  const std::uint64_t before = internal::process_memory().resident;
  fill(block, kBytes, 1);
  if (before == 0) GTEST_SKIP() << "the system does not tell how much memory is used";
  EXPECT_GT(internal::process_memory().resident, before + kBytes / 2);
  file.let_go(kBytes);
  EXPECT_LT(internal::process_memory().resident, before + kBytes / 4);
  EXPECT_TRUE(holds(block, kBytes, 1));
  file.give_back(block);
}

TEST_F(SpillFileTest, FileHasNoName) {
  SpillFile file(folder_, 0);
  void* const block = file.take(kMega);
  fill(block, kMega, 1);
  EXPECT_TRUE(fs::is_empty(folder_));
  file.give_back(block);
}

TEST_F(SpillFileTest, SmallRunsUseNoFile) {
  SpillFile file(folder_, internal::process_memory().reserved + 64 * kMega);
  EXPECT_EQ(file.take(kMega), nullptr);
  void* const block = file.take(128 * kMega);
  EXPECT_NE(block, nullptr);
  EXPECT_EQ(file.most_bytes(), 128 * kMega);
  EXPECT_FALSE(file.was_full());
  file.give_back(block);
}

TEST_F(SpillFileTest, WhereTheDiskIsFullTheSystemIsToGive) {
  SpillFile file(folder_, 0);
  void* const first = file.take(kMega);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = {};
  getrlimit(RLIMIT_FSIZE, &limit);
  rlimit small = limit;
  small.rlim_cur = 2 * kMega;
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_EQ(file.take(4 * kMega), nullptr);
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(file.was_full());
  EXPECT_EQ(file.extent(), kMega);
  void* const second = file.take(4 * kMega);
  EXPECT_NE(second, nullptr);
  file.give_back(first);
  file.give_back(second);
}

TEST_F(SpillFileTest, BlocksWithoutBoundAreRefused) {
  SpillFile file(folder_, 0);
  EXPECT_EQ(file.take(~std::size_t{0}), nullptr);
  EXPECT_EQ(file.take(~std::size_t{0} / 2), nullptr);
  EXPECT_EQ(file.extent(), 0u);
}

TEST_F(SpillFileTest, AFolderThatIsNotThereIsAnError) {
  EXPECT_THROW(SpillFile(folder_ / "none", 0), OutputError);
}

// The limit looks from time to time of a process that works.
TEST_F(SpillFileTest, MemoryComesDownToTheLimit) {
  constexpr std::size_t kBytes = 256 * kMega;
  const std::uint64_t before = internal::process_memory().resident;
  if (before == 0) GTEST_SKIP() << "the system does not tell how much memory is used";
  SpillFile file(folder_, 0);
  void* const block = file.take(kBytes);
  fill(block, kBytes, 0);
  EXPECT_GT(internal::process_memory().resident, before + kBytes / 2);
  const ResidentLimit limit(file, before + 160 * kMega);
  const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (internal::process_memory().resident > before + 160 * kMega &&
         std::chrono::steady_clock::now() < latest) {
  }
  EXPECT_LE(internal::process_memory().resident, before + 160 * kMega);
  EXPECT_TRUE(holds(block, kBytes, 0));
  file.give_back(block);
}

}  // namespace
}  // namespace meshrepair
