// How a long computation tells its caller where it is, and how the caller stops it.
#pragma once

#include <string_view>

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

}  // namespace meshrepair
