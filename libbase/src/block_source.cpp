// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <base/block_source.h>

namespace meshrepair {
namespace {

std::atomic<bool> source_has_given = false;

void* taken_from(BlockSource* source, std::size_t bytes) noexcept {
  void* const block = source == nullptr ? nullptr : source->take(bytes);
  if (block != nullptr) source_has_given.store(true, std::memory_order_relaxed);
  return block;
}

}  // namespace

void* take_block(std::size_t bytes) noexcept {
  void* const block = taken_from(block_source_for(bytes), bytes);
  return block != nullptr ? block : std::malloc(bytes);
}

// A block of the system is moved by its page tables as long as it stays the system's.
void* resize_block(void* block, std::size_t old_bytes, std::size_t bytes) noexcept {
  BlockSource* const source = block_source();
  if (source == nullptr) return std::realloc(block, bytes);
  const bool is_owned = block != nullptr && source->owns(block);
  BlockSource* const next = block_source_for(bytes);
  if (is_owned && next != nullptr && bytes <= source->size_of(block)) return block;
  void* moved = taken_from(next, bytes);
  if (moved == nullptr && !is_owned) return std::realloc(block, bytes);
  if (moved == nullptr) moved = std::malloc(bytes);
  if (moved == nullptr) return nullptr;
  if (block != nullptr) std::memcpy(moved, block, std::min(old_bytes, bytes));
  free_block(block);
  return moved;
}

void free_block(void* block) noexcept {
  BlockSource* const source = block_source();
  if (source != nullptr && source->owns(block)) {
    source->give_back(block);
  } else {
    std::free(block);
  }
}

void return_free_memory() noexcept {
#ifdef __GLIBC__
  if (source_has_given.load(std::memory_order_relaxed)) ::malloc_trim(0);
#endif
}

}  // namespace meshrepair
