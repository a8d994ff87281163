// SPDX-License-Identifier: MIT
#include "calls/worker.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <base/error.h>

#include "calls/plain_locale.h"

namespace meshrepair {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(50);

// A thread that does one piece of work after the other. It is never destroyed: it may wait for more
// when the process ends.
class Worker {
 public:
  // Throws OutOfThreads.
  Worker() {
    try {
      std::thread([this] { work_for_ever(); }).detach();
    } catch (const std::system_error&) {
      throw OutOfThreads();
    }
  }

  // Pre: the last piece is done.
  void start(const std::function<void()>& work) {
    const std::scoped_lock lock(mutex_);
    work_ = &work;
    failure_ = nullptr;
    changed_.notify_all();
  }

  // Whether the piece is done, after waiting for that a while.
  bool wait() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kBetweenLooks, [this] { return work_ == nullptr; });
  }

  // What it threw, once it is done.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  [[noreturn]] void work_for_ever() {
    const PlainLocale plain;
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return work_ != nullptr; });
      lock.unlock();
      std::exception_ptr failure;
      try {
        (*work_)();
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      failure_ = std::move(failure);
      work_ = nullptr;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* work_ = nullptr;  // null: none
  std::exception_ptr failure_;
};

// Workers that wait for the next call. With a new thread for each call oneTBB would keep some
// kilobytes of each.
class IdleWorkers {
 public:
  Worker& take() {
    const std::scoped_lock lock(mutex_);
    // A fork copies no threads.
    if (process_ != getpid()) idle_.clear();
    process_ = getpid();
    if (idle_.empty()) return *new Worker;
    Worker& worker = *idle_.back();
    idle_.pop_back();
    return worker;
  }

  void put_back(Worker& worker) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(&worker);
  }

 private:
  std::mutex mutex_;
  pid_t process_ = getpid();
  std::vector<Worker*> idle_;
};

IdleWorkers& idle_workers() {
  static auto& all = *new IdleWorkers;
  return all;
}

// A worker for one call, which does not end before it.
class HiredWorker {
 public:
  explicit HiredWorker(const std::function<void()>& work) : worker_(idle_workers().take()) {
    worker_.start(work);
  }
  HiredWorker(const HiredWorker&) = delete;
  HiredWorker& operator=(const HiredWorker&) = delete;
  ~HiredWorker() {
    while (!worker_.wait()) continue;
    idle_workers().put_back(worker_);
  }

  [[nodiscard]] Worker& get() { return worker_; }

 private:
  Worker& worker_;
};

}  // namespace

void let_look() {}

void run_watched(const std::function<void()>& work, const std::function<void()>& look) {
  std::exception_ptr raised;  // by `look`
  {
    HiredWorker worker(work);
    while (!worker.get().wait()) {
      if (raised) continue;
      try {
        look();
      } catch (...) {
        raised = std::current_exception();
      }
    }
    if (!raised) worker.get().rethrow();
  }
  if (raised) std::rethrow_exception(raised);
}

}  // namespace meshrepair
