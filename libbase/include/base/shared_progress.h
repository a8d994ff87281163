// SPDX-License-Identifier: MIT
// One observer for several threads.
#pragma once

#include <cstddef>
#include <mutex>

#include <base/error.h>
#include <base/progress.h>

namespace meshrepair {

// Counts finished pieces of work from any thread and passes them on, one call at a time. What the
// observer throws, and Cancelled, leave the function that was called.
class SharedProgress {
 public:
  // `observer` may be null. `pieces` is the number of calls of done() to come.
  SharedProgress(ProgressObserver* observer, std::size_t pieces)
      : observer_(observer), pieces_(pieces) {}

  void done() {
    if (observer_ == nullptr) return;
    const std::scoped_lock lock(mutex_);
    ++done_;
    observer_->advance(static_cast<double>(done_) / static_cast<double>(pieces_));
    ask();
  }

  // To be called now and then within a long piece. Another thread that is asking already is enough.
  void poll() {
    if (observer_ == nullptr) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) ask();
  }

 private:
  void ask() {
    if (observer_->cancelled()) throw Cancelled();
  }

  ProgressObserver* observer_;
  std::size_t pieces_;
  std::size_t done_ = 0;
  std::mutex mutex_;
};

}  // namespace meshrepair
