// SPDX-License-Identifier: MIT
// The terminal itself, whatever the standard streams are, for questions to it.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace meshrepair {

// Without echo and without waiting for whole lines as long as this lives, which is true of one at a
// time. However the process ends meanwhile, but for SIGKILL and faults of its own, the terminal is
// as before: see restore_terminal().
class RawTerminal {
 public:
  using Clock = std::chrono::steady_clock;

  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  // False: there is none, or this process is in its background.
  [[nodiscard]] bool is_ready() const { return is_ready_; }

  [[nodiscard]] bool write(std::string_view text) const;

  // Some of what has come until then; empty: nothing has. None: nothing will come.
  [[nodiscard]] std::optional<std::string> read_until(Clock::time_point end) const;

 private:
  int descriptor_;
  bool is_ready_ = false;
  bool has_handlers_ = false;
};

// Makes the terminal what it was before the RawTerminal that lives, if any. For what ends the
// process without destructors. Safe to call from a signal handler, and from any thread.
void restore_terminal() noexcept;

}  // namespace meshrepair
