// SPDX-License-Identifier: MIT
// Keeps a process that uses a SpillFile within its memory.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>
#include <vector>

#include "spill/spill_file.h"

namespace meshrepair {

// As long as it is there and the file has blocks, the process looks at each tick how much memory
// it has, and lets go of pages of the file before it is more than `bytes`. This is done at a signal
// (SIGRTMIN), in a thread that is at work: one of its own would come too late on a busy machine.
// There is one at a time.
class ResidentLimit {
 public:
  // The system may take longer. Less than a second, as each tick.
  static constexpr std::chrono::nanoseconds kTick = std::chrono::microseconds(500);

  // `file` must outlive it. The more threads may work, the earlier letting go begins. Where the
  // system has no timer left there is no limit.
  ResidentLimit(SpillFile& file, std::uint64_t bytes, std::chrono::nanoseconds tick = kTick);
  ResidentLimit(const ResidentLimit&) = delete;
  ResidentLimit& operator=(const ResidentLimit&) = delete;
  ~ResidentLimit();

 private:
  void start();

  SpillFile& file_;
  std::chrono::nanoseconds tick_;
  std::vector<timer_t> timers_;
};

}  // namespace meshrepair
