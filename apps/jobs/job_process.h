// SPDX-License-Identifier: MIT
// A job as a copy of this process, so that a crash or a limit costs no other.
//
// The copy starts with what this process has linked, read and prepared, which takes longer than the
// repair of a small mesh. On Linux it dies when this process dies. Only a process without other
// threads may be copied.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace meshrepair {

class JobProcess {
 public:
  // What the copy runs: it hands what it found to `answer`, once, and returns its exit code.
  using Answer = std::function<void(std::string_view)>;
  using Work = std::function<int(const Answer& answer)>;

  // Makes a place for what copies say, one after the other. Throws Error.
  JobProcess();
  JobProcess(JobProcess&& other) noexcept;
  JobProcess& operator=(JobProcess&&) = delete;
  // Kills what runs.
  ~JobProcess();

  // The copy has nothing on its standard input. What it prints is kept, and `closed` is closed in
  // it. Throws LimitError where the system gives no process. Pre: none is running.
  void start(const Work& work, int closed);
  [[nodiscard]] bool is_running() const { return process_ > 0; }

  // To end in order; if it has not by then, it is killed.
  void terminate(std::chrono::duration<double> grace);
  // Kills it if it is late. How long it has until then; none: -1.
  [[nodiscard]] int enforce();

  struct Ended {
    int signal = 0;     // that has killed it
    int exit_code = 0;  // as a shell has it, 128 and its number for a signal
    std::uint64_t peak_memory = 0;
    std::string answer;  // empty: it gave none, or was killed meanwhile
    std::string said;    // on standard output and standard error, the end of it
  };
  // Whether it has ended, without waiting.
  [[nodiscard]] bool poll(Ended& ended);

  // From here on signals come during wait() alone, so that none goes by unseen.
  static void hold_signals();
  struct Ready {
    bool input = false, output = false;
  };
  // Waits until a copy ends, a signal comes, or one of these is ready: `input`, -1 for none, and
  // `output`, if there `is_more` for it or nobody reads it any longer. -1: as long as it takes.
  // It may return earlier, with neither.
  static Ready wait(int input, int output, bool is_more, int milliseconds);

 private:
  using Clock = std::chrono::steady_clock;

  pid_t process_ = -1;
  int answer_ = -1;  // files in memory
  int said_ = -1;
  bool is_told_to_end_ = false;
  bool is_killed_ = false;
  Clock::time_point killed_at_;  // if it has been told to end
};

}  // namespace meshrepair
