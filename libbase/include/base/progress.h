// SPDX-License-Identifier: MIT
// How a long computation tells its caller where it is, and how the caller stops it.
#pragma once

#include <cstddef>
#include <string_view>

#include <base/error.h>

namespace meshrepair {

// Called from one thread at a time. All functions may be left as they are.
class ProgressObserver {
 public:
  ProgressObserver() = default;
  ProgressObserver(const ProgressObserver&) = delete;
  ProgressObserver& operator=(const ProgressObserver&) = delete;
  virtual ~ProgressObserver() = default;

  // A stage begins ("read", "tree", "cells", ...).
  virtual void stage(std::string_view /*name*/) {}
  // The current stage is done to this share, 0 to 1, not decreasing within a stage.
  virtual void advance(double /*share*/) {}
  // Asked every few milliseconds; true makes the computation throw Cancelled. An observer may throw
  // an exception of its own instead (LimitError, say).
  virtual bool cancelled() { return false; }
};

// Passes on the wish to stop alone, for work that is a small part of a stage.
class CancelOnly : public ProgressObserver {
 public:
  // `observer` may be null.
  explicit CancelOnly(ProgressObserver* observer) : observer_(observer) {}
  bool cancelled() override { return observer_ != nullptr && observer_->cancelled(); }

 private:
  ProgressObserver* observer_;
};

// Passes on a whole as a share of the observer's stage: from one share of it to another.
class ShareOfStage : public ProgressObserver {
 public:
  // `observer` may be null.
  ShareOfStage(ProgressObserver* observer, double from, double to)
      : observer_(observer), from_(from), to_(to) {}
  void advance(double share) override {
    if (observer_ != nullptr) observer_->advance(from_ + share * (to_ - from_));
  }
  bool cancelled() override { return observer_ != nullptr && observer_->cancelled(); }

 private:
  ProgressObserver* observer_;
  double from_, to_;
};

// For work in steps whose number is not known: each is half of what is left of the observer's
// stage.
class HalvedStage : public ProgressObserver {
 public:
  // `observer` may be null.
  explicit HalvedStage(ProgressObserver* observer) : observer_(observer) {}
  // The next step. Of what a step tells, only what is more than before is passed on.
  void begin_step() {
    from_ = to_;
    to_ = (from_ + 1) / 2;
  }
  void advance(double share) override {
    const double at = from_ + share * (to_ - from_);
    if (observer_ == nullptr || at <= at_) return;
    at_ = at;
    observer_->advance(at);
  }
  bool cancelled() override { return observer_ != nullptr && observer_->cancelled(); }

 private:
  ProgressObserver* observer_;
  double from_ = 0, to_ = 0;  // of the step
  double at_ = 0;
};

// For loops whose turns are too short to ask in each: asks in one of a thousand.
class CancelCheck {
 public:
  // `progress` may be null.
  explicit CancelCheck(ProgressObserver* progress) : progress_(progress) {}

  // Throws Cancelled when the observer says so.
  void tick() {
    if (++ticks_ % kTicksPerQuestion == 0) ask();
  }
  // At once.
  void ask() {
    if (progress_ != nullptr && progress_->cancelled()) throw Cancelled();
  }

 private:
  static constexpr std::size_t kTicksPerQuestion = 1024;

  ProgressObserver* progress_;
  std::size_t ticks_ = 0;
};

}  // namespace meshrepair
