// Keeps a process that uses a SpillFile within its memory.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "spill/spill_file.h"

namespace meshrepair {

// A thread that looks some thousand times a second how much memory the process has, and lets go of
// pages of the file before it is more than `bytes`.
class ResidentLimit {
 public:
  // `file` must outlive it.
  ResidentLimit(SpillFile& file, std::uint64_t bytes);
  ResidentLimit(const ResidentLimit&) = delete;
  ResidentLimit& operator=(const ResidentLimit&) = delete;
  ~ResidentLimit();

 private:
  void watch();
  bool keep();

  SpillFile& file_;
  std::uint64_t most_;  // bytes, less than the limit
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace meshrepair
