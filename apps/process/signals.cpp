// SPDX-License-Identifier: MIT
#include "process/signals.h"

#include <atomic>
#include <csignal>
#include <unistd.h>

#include <base/atomic_file.h>

#include "terminal/raw_terminal.h"

namespace meshrepair {
namespace {

std::atomic<int> first_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a handler may touch lock-free atomics only");

extern "C" void handle_signal(int number) {
  int none = 0;
  if (first_signal.compare_exchange_strong(none, number)) return;
  remove_unfinished_file();
  restore_terminal();
  _exit(128 + number);
}

}  // namespace

// Without SA_RESTART: a program that waits for its standard input must wake up.
void install_signal_handler(int number) {
  struct sigaction action = {};
  sigaction(number, nullptr, &action);
  if (action.sa_handler == SIG_IGN) return;
  action = {};
  action.sa_handler = handle_signal;
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

void install_signal_handlers() {
  install_signal_handler(SIGHUP);
  install_signal_handler(SIGINT);
  install_signal_handler(SIGTERM);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

int received_signal() noexcept { return first_signal.load(); }

}  // namespace meshrepair
