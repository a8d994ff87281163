// SPDX-License-Identifier: MIT
#include "without_lock.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <unistd.h>

#include "calls/worker.h"

namespace meshrepair {
namespace {

namespace py = pybind11;

// Where work does not look whether it is to stop, or a progress function does not return, Python
// ends all the same.
constexpr std::chrono::seconds kMostForStopping(10);

// The work under way, of all threads.
class WorkUnderWay {
 public:
  void add(int count) {
    const std::scoped_lock lock(mutex_);
    // The threads of a process that was forked are not there.
    if (process_ != getpid()) count_ = 0;
    process_ = getpid();
    count_ += count;
    changed_.notify_all();
  }

  // The thread that ends Python may still work.
  [[nodiscard]] bool is_to_stop() const {
    const std::thread::id stopper = stopper_;
    return stopper != std::thread::id() && stopper != std::this_thread::get_id();
  }

  void stop() {
    stopper_ = std::this_thread::get_id();
    add(0);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kMostForStopping, [this] { return count_ == 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  pid_t process_ = getpid();
  int count_ = 0;
  std::atomic<std::thread::id> stopper_ = std::thread::id();  // none yet
};

// Never destroyed: threads may still ask when the process ends.
WorkUnderWay& work_under_way() {
  static auto& all = *new WorkUnderWay;
  return all;
}

struct CountedWork {
  CountedWork() { work_under_way().add(1); }
  CountedWork(const CountedWork&) = delete;
  CountedWork& operator=(const CountedWork&) = delete;
  ~CountedWork() { work_under_way().add(-1); }
};

void tell(CallProgress& progress, const py::object& told) {
  if (told.is_none()) return;
  for (const CallProgress::Event& event : progress.take_events()) {
    told(py::str(event.stage), event.share);
  }
}

Outcome run_without_lock(const Session& session, const Session::Body& body,
                         const py::object& told) {
  const CountedWork counted;
  CallProgress progress(session.limits());
  if (work_under_way().is_to_stop()) progress.ask_to_stop();
  Outcome outcome;
  const auto look = [&] {
    if (work_under_way().is_to_stop()) progress.ask_to_stop();
    const py::gil_scoped_acquire locked;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      tell(progress, told);
    } catch (...) {
      progress.ask_to_stop();
      throw;
    }
  };
  {
    const py::gil_scoped_release unlocked;
    run_watched([&] { outcome = session.run(progress, body); }, look);
  }
  tell(progress, told);
  return outcome;
}

}  // namespace

void stop_work_at_exit() {
  const auto stop = [] {
    const py::gil_scoped_release unlocked;
    work_under_way().stop();
  };
  py::module_::import("atexit").attr("register")(py::cpp_function(stop));
}

Runner without_lock(const py::object& told) {
  return [told](const Session& session, const Session::Body& body) {
    return run_without_lock(session, body, told);
  };
}

}  // namespace meshrepair
