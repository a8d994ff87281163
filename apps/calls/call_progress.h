// SPDX-License-Identifier: MIT
// The observer of a call: what the work tells is kept for the thread that waits for it.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "process/progress_bar.h"

namespace meshrepair {

class CallProgress : public ProgressBar {
 public:
  struct Event {
    std::string stage;
    double share = 0;
  };

  explicit CallProgress(const Options& options) : ProgressBar(options) {}

  void stage(std::string_view name) override;
  void advance(double share) override;
  bool cancelled() override;

  // From another thread.
  void ask_to_stop() { asked_to_stop_ = true; }
  [[nodiscard]] bool is_asked_to_stop() const { return asked_to_stop_; }
  // What was told since the last call: each stage, and of the last one how far it is.
  [[nodiscard]] std::vector<Event> take_events();

 private:
  std::mutex mutex_;  // for the events
  std::vector<Event> events_;
  bool has_new_ = false;  // events that nobody has taken
  std::atomic<bool> asked_to_stop_ = false;
};

}  // namespace meshrepair
