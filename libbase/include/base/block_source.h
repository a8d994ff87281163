// SPDX-License-Identifier: MIT
// Where the memory of large arrays comes from: the system, or what a program puts in its place.
#pragma once

#include <atomic>
#include <cstddef>

namespace meshrepair {

// Blocks from this size on are asked of the source, where nothing else is said.
inline constexpr std::size_t kLeastBlock = std::size_t{1} << 20;  // bytes

// Gives and takes back large blocks of memory. All blocks lie between two addresses that never
// change, so that one look tells whose a block is. Used by many threads.
class BlockSource {
 public:
  BlockSource() = default;
  BlockSource(const BlockSource&) = delete;
  BlockSource& operator=(const BlockSource&) = delete;
  virtual ~BlockSource() = default;

  // Aligned to a page. Null: the system is to give the block.
  [[nodiscard]] virtual void* take(std::size_t bytes) noexcept = 0;
  // A block that take() gave.
  virtual void give_back(void* block) noexcept = 0;
  // At least what was asked for.
  [[nodiscard]] virtual std::size_t size_of(const void* block) const noexcept = 0;

  [[nodiscard]] bool owns(const void* block) const noexcept {
    const char* const at = static_cast<const char*>(block);
    return at >= begin_ && at < end_;
  }

 protected:
  // Once, before the first block.
  void set_range(const char* begin, const char* end) noexcept {
    begin_ = begin;
    end_ = end;
  }

 private:
  const char* begin_ = nullptr;
  const char* end_ = nullptr;
};

namespace internal {
inline std::atomic<BlockSource*> block_source{nullptr};
inline std::atomic<std::size_t> least_block{~std::size_t{0}};
}  // namespace internal

// Null, the state at first, if all memory is the system's.
[[nodiscard]] inline BlockSource* block_source() noexcept {
  return internal::block_source.load(std::memory_order_acquire);
}

// The source that is asked for a block of this size, if any.
[[nodiscard]] inline BlockSource* block_source_for(std::size_t bytes) noexcept {
  const bool is_small = bytes < internal::least_block.load(std::memory_order_relaxed);
  return is_small ? nullptr : block_source();
}

// From now on, for blocks of at least so many bytes; blocks of the system stay what they are. The
// source has to outlive all blocks that it gives, so it is for the rest of the process.
inline void set_block_source(BlockSource* source, std::size_t least = kLeastBlock) noexcept {
  internal::least_block.store(source == nullptr ? ~std::size_t{0} : least,
                              std::memory_order_relaxed);
  internal::block_source.store(source, std::memory_order_release);
}

// Those of malloc(), realloc() and free(), but for large blocks. Null if there is no memory, and
// the old block is as it was. `old_bytes` are those that it holds.
[[nodiscard]] void* take_block(std::size_t bytes) noexcept;
[[nodiscard]] void* resize_block(void* block, std::size_t old_bytes, std::size_t bytes) noexcept;
void free_block(void* block) noexcept;

// Once a source has given a block, what small ones have left goes back to the system, which keeps
// pages of large ones there: a stage with many small blocks would take that room from all that
// follow.
void return_free_memory() noexcept;

}  // namespace meshrepair
