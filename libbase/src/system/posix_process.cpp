// SPDX-License-Identifier: MIT
#include <array>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

#include <base/internal/processes.h>
#include <base/internal/system.h>

namespace meshrepair::internal {
namespace {

double seconds_of(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

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

double cpu_seconds() noexcept {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

std::size_t peak_memory() noexcept {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return peak_memory_of(usage);
}

void end_process_now(int code) noexcept { _exit(code); }

bool is_open(int descriptor) noexcept { return ::fcntl(descriptor, F_GETFD) != -1; }

// Without SA_RESTART: a program that waits for its standard input must wake up.
void handle_request_to_end(int number, void (*handle)(int number)) noexcept {
  struct sigaction action = {};
  ::sigaction(number, nullptr, &action);
  if (action.sa_handler == SIG_IGN) return;
  action = {};
  action.sa_handler = handle;
  sigemptyset(&action.sa_mask);
  ::sigaction(number, &action, nullptr);
}

int request_to_end_without_handler() noexcept { return 0; }

void prepare_standard_streams() noexcept {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

std::thread thread_without_signals(std::function<void()> work) {
  const SignalsBlocked blocked;
  return std::thread(std::move(work));
}

bool is_terminal(int descriptor) noexcept { return ::isatty(descriptor) == 1; }

int terminal_columns(int descriptor) noexcept {
  winsize size = {};
  return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace meshrepair::internal
