// SPDX-License-Identifier: MIT
// The observer of every program: times the stages, draws them, and passes on signals and limits.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/error.h>
#include <base/progress.h>

#include "process/exit_code.h"

namespace meshrepair {

struct StageTime {
  std::string name;
  double seconds = 0;
};

// One line of at most `columns` characters: stage, share, bar, seconds. Share is clamped to 0 to 1.
[[nodiscard]] std::string progress_line(std::string_view stage, double share, double seconds,
                                        int columns);

class ProgressBar : public ProgressObserver {
 public:
  struct Options {
    bool draw = false;               // on `terminal`, from the first half second on
    double time_limit = 0;           // seconds from construction on; 0 is none
    std::uint64_t memory_limit = 0;  // bytes; 0 is none
    bool spills = false;             // what is a file's can be let go of, so it does not count
    std::FILE* terminal = stderr;    // not owned
    int told = -1;                   // a descriptor that gets a line for each percent; -1: none
    double delay = 0.5;              // seconds before anything is drawn: short runs stay silent
  };

  explicit ProgressBar(const Options& options);
  ProgressBar() : ProgressBar(Options()) {}
  ~ProgressBar() override;

  void stage(std::string_view name) override;
  void advance(double share) override;
  // True once a signal was received. Throws LimitError once a limit is reached.
  bool cancelled() override;

  // Why the work has to stop, if it has to. From any thread.
  [[nodiscard]] std::optional<Failure> reason_to_stop() const;
  // Whether the work was told to stop. From any thread.
  [[nodiscard]] bool work_is_ending() const { return work_is_ending_; }
  // For std::bad_alloc: the limit, the stage and how far it was.
  [[nodiscard]] std::string out_of_memory() const;
  // For a thread that the system refuses.
  [[nodiscard]] LimitError out_of_threads() const;
  // What clears the line on the terminal.
  [[nodiscard]] std::string clearing() const { return options_.draw ? "\r\x1b[K" : ""; }

  // Ends the last stage and clears the line. May be called more than once.
  void finish();

  // The stages so far, in order of their first start; one that was entered again adds up. The
  // current one is included after finish() only.
  [[nodiscard]] const std::vector<StageTime>& stages() const { return stages_; }
  // Since construction.
  [[nodiscard]] double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;

  void end_stage();
  // "in stage 'cells', 43 % done".
  [[nodiscard]] std::string where() const;
  [[nodiscard]] std::optional<std::string> limit_reached() const;
  void draw();
  void tell();
  void clear();

  Options options_;
  std::atomic<bool> work_is_ending_ = false;
  Clock::time_point start_;
  Clock::time_point stage_start_;
  Clock::time_point last_drawn_;
  Clock::time_point last_question_;  // long ago at first
  mutable std::mutex where_mutex_;   // for the two that follow: they are read from other threads
  std::string stage_;
  double share_ = 0;
  bool line_is_drawn_ = false;
  int told_percent_ = -1;  // of the stage
  std::vector<StageTime> stages_;
};

}  // namespace meshrepair
