// SPDX-License-Identifier: MIT
#include "process/watchdog.h"

#include <chrono>
#include <csignal>
#include <new>
#include <optional>
#include <poll.h>
#include <unistd.h>
#include <utility>

#include <base/atomic_file.h>

#include "terminal/raw_terminal.h"

namespace meshrepair {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(50);
constexpr int kMostLooks = 15;  // with a reason to stop

// Signals are for the threads that wait for input and output: they are to wake up.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

}  // namespace

Watchdog::Watchdog(std::string program, const ProgressBar& progress)
    : program_(std::move(program)), progress_(progress) {
  const SignalsBlocked blocked;
  thread_ = std::thread([this] { watch(); });
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
      if (looks_in_vain > kMostLooks) end_process(*reason);
    } catch (const std::bad_alloc&) {
      // The work meets it, too, and gives some back when it ends.
    }
  }
}

// Without the streams of the C library, whose locks the work may hold, and without waiting for
// anyone to read. The file goes last: the work may have made it just now.
void Watchdog::end_process(const Failure& reason) const {
  const std::string line = progress_.clearing() + program_ + ": " + reason.message + "\n";
  pollfd standard_error = {STDERR_FILENO, POLLOUT, 0};
  if (::poll(&standard_error, 1, 0) > 0) {
    const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
    static_cast<void>(written);
  }
  remove_unfinished_file();
  restore_terminal();
  _exit(static_cast<int>(reason.code));
}

}  // namespace meshrepair
