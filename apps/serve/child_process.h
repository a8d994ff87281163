// SPDX-License-Identifier: MIT
// A program of ours as another process, which tells how far it is.
#pragma once

#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace meshrepair {

class ChildProcess {
 public:
  // `command`: the path of the program, and its arguments. "--progress-fd" is added to them. It
  // works in the folder of this descriptor. What it prints goes nowhere. On Linux it is
  // killed when this process dies. Throws Error where it cannot be started.
  ChildProcess(const std::vector<std::string>& command, int folder);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  // Kills it, if it has not ended.
  ~ChildProcess();

  // Waits a tenth of a second at most for what it tells. False: it has ended.
  [[nodiscard]] bool wait();
  // The stage and percent that it told last.
  [[nodiscard]] const std::pair<std::string, int>& progress() const { return progress_; }
  // To end in order; or at once.
  void terminate() const;
  void kill() const;

  // Once it has ended: as a shell has it, 128 and its number for a signal.
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  void take_lines();
  void reap();

  pid_t process_ = -1;
  int told_ = -1;  // the end of a pipe
  std::string unread_;
  std::pair<std::string, int> progress_;
  int exit_code_ = -1;
};

}  // namespace meshrepair
