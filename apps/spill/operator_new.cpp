// SPDX-License-Identifier: MIT
// The memory of all containers in a program: large blocks come from its source of blocks. Linked
// into programs alone, as a process has one operator new.
#include <cstdlib>
#include <new>

#include <base/block_source.h>

namespace {

using namespace meshrepair;

void* taken(std::size_t bytes) {
  for (;;) {
    if (void* const block = take_block(bytes == 0 ? 1 : bytes)) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

// Blocks of a source are aligned to pages.
void* taken_aligned(std::size_t bytes, std::size_t alignment) {
  if (BlockSource* const source = block_source_for(bytes)) {
    if (void* const taken = source->take(bytes)) return taken;
  }
  void* block = nullptr;
  if (::posix_memalign(&block, alignment, bytes == 0 ? 1 : bytes) != 0) throw std::bad_alloc();
  return block;
}

}  // namespace

void* operator new(std::size_t bytes) { return taken(bytes); }
void* operator new[](std::size_t bytes) { return taken(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t& /*unused*/) noexcept {
  return take_block(bytes == 0 ? 1 : bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t& /*unused*/) noexcept {
  return take_block(bytes == 0 ? 1 : bytes);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return taken_aligned(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return taken_aligned(bytes, static_cast<std::size_t>(alignment));
}

void operator delete(void* block) noexcept { free_block(block); }
void operator delete[](void* block) noexcept { free_block(block); }
void operator delete(void* block, std::size_t /*bytes*/) noexcept { free_block(block); }
void operator delete[](void* block, std::size_t /*bytes*/) noexcept { free_block(block); }
void operator delete(void* block, const std::nothrow_t& /*unused*/) noexcept { free_block(block); }
void operator delete[](void* block, const std::nothrow_t& /*unused*/) noexcept {
  free_block(block);
}
void operator delete(void* block, std::align_val_t /*alignment*/) noexcept { free_block(block); }
void operator delete[](void* block, std::align_val_t /*alignment*/) noexcept { free_block(block); }
void operator delete(void* block, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  free_block(block);
}
void operator delete[](void* block, std::size_t /*bytes*/,
                       std::align_val_t /*alignment*/) noexcept {
  free_block(block);
}
