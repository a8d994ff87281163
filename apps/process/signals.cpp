// SPDX-License-Identifier: MIT
#include "process/signals.h"

#include <atomic>

#include <base/atomic_file.h>
#include <base/internal/system.h>

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
  internal::end_process_now(128 + number);
}

}  // namespace

void install_signal_handler(int number) { internal::handle_request_to_end(number, handle_signal); }

void install_signal_handlers() {
  install_signal_handler(internal::kHangUp);
  install_signal_handler(internal::kInterrupt);
  install_signal_handler(internal::kTerminate);
  internal::prepare_standard_streams();
}

int received_signal() noexcept {
  const int noted = first_signal.load();
  return noted != 0 ? noted : internal::request_to_end_without_handler();
}

}  // namespace meshrepair
