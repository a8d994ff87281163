// SPDX-License-Identifier: MIT
// Sees to it that a program ends in time when it has to, even where the work does not ask whether
// to go on.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "process/exit_code.h"
#include "process/progress_bar.h"

namespace meshrepair {

// A thread that looks now and then whether there is a reason to stop (see
// ProgressBar::reason_to_stop). The work is expected to notice by itself within three quarters of a
// second, and to end in order within five. Else the watchdog says why on stderr, removes the
// unfinished output file, restores the terminal and ends the process with the exit code of that
// reason. There is no report then.
class Watchdog {
 public:
  // `progress` must outlive the watchdog.
  Watchdog(std::string program, const ProgressBar& progress);
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  ~Watchdog();

 private:
  void watch();
  [[noreturn]] void end_process(const Failure& reason) const;

  std::string program_;
  const ProgressBar& progress_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace meshrepair
