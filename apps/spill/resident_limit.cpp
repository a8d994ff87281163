// SPDX-License-Identifier: MIT
#include "spill/resident_limit.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>

#include <base/internal/system.h>
#include <base/parallel.h>

namespace meshrepair {
namespace {

constexpr std::size_t kAtOnce = std::size_t{32} << 20;  // addresses; a look follows
// Pages that are in the file's cache come back fast: what threads may take between two looks.
constexpr double kSparedShare = 0.25;
constexpr double kSparedAlways = 128 << 20, kSparedForThread = 128 << 20;  // bytes
constexpr double kMostSpared = 0.5;                                        // of the limit
constexpr std::array<clockid_t, 2> kClocks = {CLOCK_MONOTONIC, CLOCK_PROCESS_CPUTIME_ID};
constexpr double kEnd = 0.9;  // of where letting go begins: where it ends
// The same, beyond what cannot be let go of: where it begins and ends.
constexpr double kBeyondHeld = 0.2, kEndBeyondHeld = 0.05;

// What the handler works with; it starts with a file.
std::atomic<SpillFile*> file_at_work = nullptr;
std::atomic<std::uint64_t> most_resident = 0;
static_assert(std::atomic<SpillFile*>::is_always_lock_free &&
                  std::atomic<std::uint64_t>::is_always_lock_free,
              "a handler may touch lock-free atomics only");

// Letting go begins here.
std::uint64_t most_of(std::uint64_t limit) {
  const auto bytes = static_cast<double>(limit);
  const double taken = kSparedAlways + kSparedForThread * static_cast<double>(most_threads());
  const double spared = std::min(std::max(kSparedShare * bytes, taken), kMostSpared * bytes);
  return static_cast<std::uint64_t>(bytes - spared);
}

std::uint64_t share_of(std::uint64_t bytes, double share) {
  return static_cast<std::uint64_t>(share * static_cast<double>(bytes));
}

// Once round at most: what is not in the file cannot be let go of. Where that alone is about as
// much as there may be, letting go has to wait until it brings something, or nothing else would be
// done.
void keep(SpillFile& file) noexcept {
  const std::uint64_t most = most_resident.load();
  const auto [resident, held, reserved] = internal::process_memory();
  if (resident <= most || resident <= held + share_of(most, kBeyondHeld)) return;
  const std::uint64_t end = std::max(share_of(most, kEnd), held + share_of(most, kEndBeyondHeld));
  for (std::size_t passed = 0; passed < file.extent(); passed += kAtOnce) {
    file.let_go(kAtOnce);
    if (internal::process_memory().resident <= end) return;
  }
}

extern "C" void handle_tick(int /*number*/) {
  const int error = errno;
  SpillFile* const file = file_at_work.load();
  if (file != nullptr) keep(*file);
  errno = error;
}

}  // namespace

ResidentLimit::ResidentLimit(SpillFile& file, std::uint64_t bytes, std::chrono::nanoseconds tick)
    : file_(file), tick_(tick) {
  most_resident = most_of(bytes);
  file_at_work = &file;
  timers_.reserve(kClocks.size());  // start() may not throw
  file.at_first_block([this] { start(); });
}

// Small runs, which need no file, are not interrupted. The one timer is exact, but its signal may
// wait for a thread that the disk or another process keeps; that of the other comes to the thread
// that works.
void ResidentLimit::start() {
  struct sigaction action = {};
  action.sa_handler = handle_tick;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGRTMIN, &action, nullptr);
  sigevent event = {};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGRTMIN;
  const timespec tick = {0, static_cast<long>(tick_.count())};
  const itimerspec times = {tick, tick};
  for (const clockid_t clock : kClocks) {
    timer_t timer = {};
    if (::timer_create(clock, &event, &timer) != 0) continue;
    ::timer_settime(timer, 0, &times, nullptr);
    timers_.push_back(timer);
  }
}

// A signal that is under way finds nothing to do.
ResidentLimit::~ResidentLimit() {
  file_.at_first_block({});
  for (const timer_t timer : timers_) ::timer_delete(timer);
  file_at_work = nullptr;
}

}  // namespace meshrepair
