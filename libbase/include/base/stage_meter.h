// SPDX-License-Identifier: MIT
// Seconds and peak memory of each stage.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <base/progress.h>

namespace meshrepair {

struct StageReport {
  std::string name;
  double seconds = 0;
  double cpu_seconds = 0;      // of all threads
  std::size_t peak_bytes = 0;  // the process's resident memory at most, up to the end of the stage
};

// Measures from begin() to the next begin() or end(). Tells the observer, if there is one, and
// returns free memory.
class StageMeter {
 public:
  StageMeter(std::vector<StageReport>& stages, ProgressObserver* progress)
      : stages_(stages), progress_(progress) {}
  StageMeter(const StageMeter&) = delete;
  StageMeter& operator=(const StageMeter&) = delete;
  ~StageMeter() { end(); }

  void begin(std::string_view name);
  void end() noexcept;

 private:
  std::vector<StageReport>& stages_;
  ProgressObserver* progress_;
  bool running_ = false;
  double wall_start_ = 0;
  double cpu_start_ = 0;
};

}  // namespace meshrepair
