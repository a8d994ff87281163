// SPDX-License-Identifier: MIT
// What the terminal was lies in a place that signal handlers find: first it is noted, then the
// terminal is changed, and it is forgotten only once the terminal is as before. So each moment in
// between restores it, some twice, which does no harm.
#include "terminal/raw_terminal.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace meshrepair {
namespace {

// The keys of the terminal send these, and who notes no signal (see signals.h) is ended or stopped
// by them as by default.
constexpr std::array<int, 2> kSignals = {SIGQUIT, SIGTSTP};

std::atomic<int> raw_descriptor = -1;
static_assert(std::atomic<int>::is_always_lock_free, "a handler may touch lock-free atomics only");
termios noted;  // what it was, as long as there is a descriptor
std::array<struct sigaction, kSignals.size()> actions_before;

// The default follows, once this returns: SA_RESETHAND has put it back.
extern "C" void restore_and_follow(int number) {
  const int error = errno;
  restore_terminal();
  (void)::raise(number);
  errno = error;
}

void handle_signals() {
  struct sigaction action = {};
  action.sa_handler = restore_and_follow;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &actions_before[i]);
    if (actions_before[i].sa_handler == SIG_DFL) ::sigaction(kSignals[i], &action, nullptr);
  }
}

void handle_signals_as_before() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &actions_before[i], nullptr);
  }
}

}  // namespace

RawTerminal::RawTerminal() : descriptor_(::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  if (descriptor_ < 0) return;
  // Others would be stopped.
  is_ready_ = ::tcgetpgrp(descriptor_) == ::getpgrp() && ::tcgetattr(descriptor_, &noted) == 0;
  if (!is_ready_) return;
  termios raw = noted;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  raw_descriptor.store(descriptor_);
  handle_signals();
  has_handlers_ = true;
  is_ready_ = ::tcsetattr(descriptor_, TCSANOW, &raw) == 0;
}

RawTerminal::~RawTerminal() {
  restore_terminal();
  if (has_handlers_) handle_signals_as_before();
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool RawTerminal::write(std::string_view text) const {
  return ::write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

std::optional<std::string> RawTerminal::read_until(Clock::time_point end) const {
  pollfd wait = {descriptor_, POLLIN, 0};
  int ready = 0;
  do {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return "";
    ready = ::poll(&wait, 1, static_cast<int>(left.count()));
  } while (ready < 0 && errno == EINTR);
  if (ready <= 0) return "";
  if (raw_descriptor.load() < 0) return std::nullopt;  // this process was stopped meanwhile
  std::array<char, 256> some{};
  const ssize_t count = ::read(descriptor_, some.data(), some.size());
  if (count <= 0) return std::nullopt;
  return std::string(some.data(), static_cast<std::size_t>(count));
}

void restore_terminal() noexcept {
  const int descriptor = raw_descriptor.load();
  if (descriptor < 0) return;
  (void)::tcsetattr(descriptor, TCSANOW, &noted);
  raw_descriptor.store(-1);
}

}  // namespace meshrepair
