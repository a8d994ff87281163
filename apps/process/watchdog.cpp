// SPDX-License-Identifier: MIT
#include "process/watchdog.h"

#include <chrono>
#include <new>
#include <optional>
#include <utility>

#include <base/atomic_file.h>
#include <base/internal/system.h>

#include "terminal/raw_terminal.h"

namespace meshrepair {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(50);
constexpr int kMostLooks = 15;           // with a reason to stop
constexpr int kMostLooksAtTheEnd = 100;  // on a busy machine, what was made takes time to remove

}  // namespace

Watchdog::Watchdog(std::string program, const ProgressBar& progress)
    : program_(std::move(program)), progress_(progress) {
  thread_ = internal::thread_without_signals([this] { watch(); });
}

Watchdog::~Watchdog() {
  {
    const std::scoped_lock lock(mutex_);
    done_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Watchdog::watch() {
  int looks_in_vain = 0;
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, kBetweenLooks, [this] { return done_; })) {
    try {
      const std::optional<Failure> reason = progress_.reason_to_stop();
      looks_in_vain = reason ? looks_in_vain + 1 : 0;
      const int most = progress_.work_is_ending() ? kMostLooksAtTheEnd : kMostLooks;
      if (looks_in_vain > most) end_process(*reason);
    } catch (const std::bad_alloc&) {
      // The work meets it, too, and gives some back when it ends.
    }
  }
}

// Without the streams of the C library, whose locks the work may hold, and without waiting for
// anyone to read. The file goes last: the work may have made it just now.
void Watchdog::end_process(const Failure& reason) const {
  const std::string line = progress_.clearing() + program_ + ": " + reason.message + "\n";
  if (internal::is_ready(internal::kStandardError, internal::Direction::out)) {
    (void)internal::write_some(internal::kStandardError, line.data(), line.size());
  }
  remove_unfinished_file();
  restore_terminal();
  internal::end_process_now(static_cast<int>(reason.code));
}

}  // namespace meshrepair
