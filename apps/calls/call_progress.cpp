// SPDX-License-Identifier: MIT
#include "calls/call_progress.h"

#include <utility>

#include "calls/worker.h"

namespace meshrepair {

void CallProgress::stage(std::string_view name) {
  ProgressBar::stage(name);
  const std::scoped_lock lock(mutex_);
  if (!has_new_) events_.clear();
  events_.push_back({std::string(name), 0});
  has_new_ = true;
}

void CallProgress::advance(double share) {
  ProgressBar::advance(share);
  const std::scoped_lock lock(mutex_);
  if (events_.empty() || share <= events_.back().share) return;
  events_.back().share = share;
  has_new_ = true;
}

bool CallProgress::cancelled() {
  let_look();
  return asked_to_stop_ || ProgressBar::cancelled();
}

std::vector<CallProgress::Event> CallProgress::take_events() {
  const std::scoped_lock lock(mutex_);
  if (!std::exchange(has_new_, false)) return {};
  std::vector<Event> taken = events_;
  events_.erase(events_.begin(), events_.end() - 1);  // its share may still grow
  return taken;
}

}  // namespace meshrepair
