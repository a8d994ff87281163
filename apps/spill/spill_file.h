// SPDX-License-Identifier: MIT
// Large arrays in a file, so that the system need not keep them in memory.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>

#include <base/block_source.h>

namespace meshrepair {

// A file without a name, mapped as memory, which is cut into blocks. Its pages can be let go of at
// any time: what they hold is in the file, and they come back when they are used. The file is gone
// with the process, whatever ends it.
class SpillFile : public BlockSource {
 public:
  // In this folder. Blocks are given where the process would reserve more than `most_reserved`
  // bytes of its own without them, so that small runs use no file. They take up to four fifths of
  // what the disk has free now. Throws OutputError where no such file can be made.
  SpillFile(const std::filesystem::path& folder, std::uint64_t most_reserved);
  ~SpillFile() override;

  // Null where the disk is full, too: nothing is written later to a place that is not there.
  [[nodiscard]] void* take(std::size_t bytes) noexcept override;
  void give_back(void* block) noexcept override;
  [[nodiscard]] std::size_t size_of(const void* block) const noexcept override;

  // Is called once: now if there are blocks or were, else with the first one.
  void at_first_block(std::function<void()> call);

  // Lets go of up to `bytes` of addresses, from where the last call ended on, and round. From any
  // thread at any time, also from a signal handler.
  void let_go(std::size_t bytes) noexcept;

  // Of addresses that are in use, or were.
  [[nodiscard]] std::size_t extent() const noexcept { return extent_.load(); }
  [[nodiscard]] std::uint64_t most_bytes() const noexcept { return most_bytes_.load(); }
  [[nodiscard]] bool was_full() const noexcept { return was_full_.load(); }

 private:
  using Offset = std::uint64_t;

  // Where a hole is found for so many bytes, the smallest one, else behind all blocks.
  Offset place_for(std::uint64_t bytes);
  void add_hole(Offset at, std::uint64_t bytes);
  bool reserve(Offset at, std::uint64_t bytes) noexcept;

  int descriptor_ = -1;
  char* base_ = nullptr;
  std::uint64_t addresses_ = 0;  // from there on
  std::uint64_t most_reserved_;
  std::uint64_t room_ = 0;                  // on the disk, for all blocks
  mutable std::mutex mutex_;                // for the four that follow
  std::map<Offset, std::uint64_t> blocks_;  // by where they begin
  std::map<Offset, std::uint64_t> holes_;   // between blocks
  std::uint64_t bytes_ = 0;                 // of blocks
  std::function<void()> at_first_block_;
  std::atomic<std::uint64_t> most_bytes_ = 0;
  std::atomic<std::size_t> extent_ = 0;
  std::atomic<bool> was_full_ = false;
  std::atomic<std::size_t> hand_ = 0;  // where let_go() goes on
};

}  // namespace meshrepair
