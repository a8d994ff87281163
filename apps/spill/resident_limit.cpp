#include "spill/resident_limit.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "common/memory_limit.h"

namespace meshrepair {
namespace {

constexpr std::chrono::microseconds kWhenFar(1000), kWhenNear(200);  // between looks
constexpr std::size_t kAtOnce = std::size_t{32} << 20;               // addresses; a look follows
// Pages that are in the file's cache come back fast: what threads may take between two looks.
constexpr double kSparedShare = 0.25;
constexpr double kLeastSpared = 96 << 20;  // bytes; not more than half of the limit
constexpr double kEnd = 0.9;               // of where letting go begins: where it ends

// As of linux/sched/types.h, which not all systems install.
struct Scheduling {
  std::uint32_t size = sizeof(Scheduling);
  std::uint32_t policy = 0;  // the one of all threads
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime = 0;  // nanoseconds; a thread that asks for little is soon served
  std::uint64_t deadline = 0;
  std::uint64_t period = 0;
};

// On a busy machine this thread would come too late. Where the system knows no such wish, it waits
// as all do.
void ask_for_short_waits() {
  Scheduling wish;
  wish.runtime = 100'000;
  wish.nice = ::getpriority(PRIO_PROCESS, 0);
  static_cast<void>(::syscall(SYS_sched_setattr, 0, &wish, 0));
}

// Letting go begins here.
std::uint64_t most_of(std::uint64_t limit) {
  const auto bytes = static_cast<double>(limit);
  const double spared = std::min(std::max(kSparedShare * bytes, kLeastSpared), bytes / 2);
  return static_cast<std::uint64_t>(bytes - spared);
}

}  // namespace

ResidentLimit::ResidentLimit(SpillFile& file, std::uint64_t bytes)
    : file_(file), most_(most_of(bytes)) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { watch(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ResidentLimit::~ResidentLimit() {
  {
    const std::scoped_lock lock(mutex_);
    done_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void ResidentLimit::watch() {
  ask_for_short_waits();
  std::unique_lock lock(mutex_);
  std::chrono::microseconds pause = kWhenFar;
  while (!ended_.wait_for(lock, pause, [this] { return done_; })) {
    pause = file_.extent() > 0 && keep() ? kWhenNear : kWhenFar;
  }
}

// Lets go of what is too much; says whether more may come soon. Once round at most: what is not in
// the file cannot be let go of.
bool ResidentLimit::keep() {
  const auto end = static_cast<std::uint64_t>(kEnd * static_cast<double>(most_));
  std::uint64_t resident = resident_memory();
  if (resident <= most_) return resident > end;
  for (std::size_t passed = 0; passed < file_.extent() && resident > end; passed += kAtOnce) {
    file_.let_go(kAtOnce);
    resident = resident_memory();
  }
  return true;
}

}  // namespace meshrepair
