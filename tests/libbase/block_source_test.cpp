// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <base/block_source.h>
#include <base/trivial_vector.h>

namespace meshrepair {
namespace {

constexpr std::size_t kRoom = 8 * kLeastBlock;

// Gives blocks one behind the other, as long as there is room, and counts them.
class OneShelf : public BlockSource {
 public:
  OneShelf() : room_(new char[kRoom]) {
    set_range(room_.get(), room_.get() + kRoom);
    set_block_source(this);
  }
  ~OneShelf() override { set_block_source(nullptr); }

  void* take(std::size_t bytes) noexcept override {
    if (used_ + bytes > kRoom) return nullptr;
    sizes_.push_back(bytes);
    starts_.push_back(used_);
    used_ += bytes;
    ++taken;
    return room_.get() + starts_.back();
  }
  void give_back(void* /*block*/) noexcept override { ++given_back; }
  std::size_t size_of(const void* block) const noexcept override {
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      if (room_.get() + starts_[i] == block) return sizes_[i];
    }
    return 0;
  }

  int taken = 0;
  int given_back = 0;

 private:
  std::unique_ptr<char[]> room_;
  std::size_t used_ = 0;
  std::vector<std::size_t> sizes_, starts_;
};

TEST(BlockSource, LargeBlocksComeFromTheSource) {
  OneShelf shelf;
  void* const small = take_block(kLeastBlock - 1);
  void* const large = take_block(kLeastBlock);
  EXPECT_FALSE(shelf.owns(small));
  EXPECT_TRUE(shelf.owns(large));
  free_block(small);
  free_block(large);
  EXPECT_EQ(shelf.taken, 1);
  EXPECT_EQ(shelf.given_back, 1);
}

// Sanitizers have memory of their own.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define MESHREPAIR_OTHER_MALLOC
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define MESHREPAIR_OTHER_MALLOC
#endif

#ifndef MESHREPAIR_OTHER_MALLOC

std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  statm >> all >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// Free, but below one that is not.
std::unique_ptr<char[]> many_small_blocks(std::size_t bytes) {
  constexpr std::size_t kSmall = 1 << 14;
  std::vector<std::unique_ptr<char[]>> blocks;
  for (std::size_t i = 0; i < bytes / kSmall; ++i) blocks.emplace_back(new char[kSmall]());
  return std::move(blocks.back());
}

TEST(BlockSource, HasRoomWhereSmallBlocksWere) {
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  const auto last = many_small_blocks(kBytes);
  const std::size_t before = resident_bytes();
  OneShelf shelf;
  free_block(take_block(kLeastBlock));
  return_free_memory();
  EXPECT_LT(resident_bytes() + kBytes / 2, before);
}

#endif

TEST(BlockSource, SystemGivesBlocksThatTheSourceHasNoRoomFor) {
  OneShelf shelf;
  void* const block = take_block(2 * kRoom);
  EXPECT_NE(block, nullptr);
  EXPECT_FALSE(shelf.owns(block));
  free_block(block);
  EXPECT_EQ(shelf.given_back, 0);
}

TEST(BlockSource, WhatABlockHoldsMovesWithIt) {
  OneShelf shelf;
  auto* block = static_cast<unsigned char*>(take_block(100));
  for (unsigned char i = 0; i < 100; ++i) block[i] = i;
  std::size_t has = 100;
  // Of the system, of the source, longer there, behind its end, and back to a small one.
  for (const std::size_t bytes :
       {kLeastBlock / 2, kLeastBlock, 2 * kLeastBlock, 2 * kRoom, std::size_t{100}}) {
    block = static_cast<unsigned char*>(resize_block(block, has, bytes));
    has = bytes;
    ASSERT_NE(block, nullptr);
    for (unsigned char i = 0; i < 100; ++i) ASSERT_EQ(block[i], i) << bytes;
  }
  free_block(block);
}

TEST(BlockSource, ABlockThatShrinksStays) {
  OneShelf shelf;
  void* const block = take_block(2 * kLeastBlock);
  EXPECT_EQ(resize_block(block, 2 * kLeastBlock, kLeastBlock), block);
  EXPECT_EQ(shelf.taken, 1);
  free_block(block);
}

TEST(BlockSource, BlocksOfBeforeAreTheSystemsUntilTheyGrow) {
  void* const block = std::memset(take_block(kLeastBlock), 1, kLeastBlock);
  OneShelf shelf;
  EXPECT_FALSE(shelf.owns(block));
  auto* const moved = static_cast<char*>(resize_block(block, kLeastBlock, 2 * kLeastBlock));
  EXPECT_TRUE(shelf.owns(moved));
  EXPECT_EQ(moved[kLeastBlock - 1], 1);
  free_block(moved);
  EXPECT_EQ(shelf.given_back, 1);
}

TEST(BlockSource, VectorsGrowThroughTheSource) {
  OneShelf shelf;
  {
    TrivialVector<int> numbers;
    for (int i = 0; i < 400'000; ++i) numbers.push_back(i);
    EXPECT_TRUE(shelf.owns(numbers.data()));
    for (int i = 0; i < 400'000; ++i) ASSERT_EQ(numbers[static_cast<std::size_t>(i)], i);
  }
  EXPECT_GT(shelf.taken, 0);
  EXPECT_EQ(shelf.given_back, shelf.taken);
}

}  // namespace
}  // namespace meshrepair
