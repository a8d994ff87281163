// SPDX-License-Identifier: MIT
// One thread works without oneTBB, and so does its limit. oneTBB would try to start a second one
// all the same when the limit ends, and would end the process where the system gives none; and what
// it asks the system when it starts takes longer than the repair of a small mesh.
#include <atomic>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_group.h>
#ifdef MESHREPAIR_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

#include <base/error.h>
#include <base/parallel.h>

namespace meshrepair {
namespace {

#ifdef MESHREPAIR_THREAD_SANITIZER
void tell_before(void* what) { __tsan_release(what); }
void tell_after(void* what) { __tsan_acquire(what); }
#else
void tell_before(void* /*what*/) {}
void tell_after(void* /*what*/) {}
#endif

// Tells the thread sanitizer what oneTBB, which is not built for it, does for sure: what comes
// before a call is done before its bodies, and these before what comes after. Nothing is said of
// two bodies, so that it finds what they do to each other.
class CallOrder {
 public:
  class Body {
   public:
    explicit Body(CallOrder& call) : call_(call) { tell_after(&call_); }
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;
    ~Body() { tell_before(&call_); }

   private:
    CallOrder& call_;
  };

  CallOrder() { tell_before(this); }
  CallOrder(const CallOrder&) = delete;
  CallOrder& operator=(const CallOrder&) = delete;
  ~CallOrder() { end(); }

  // The bodies are done, and what one of them threw may be looked at.
  void end() { tell_after(this); }
};

// oneTBB has no type for it.
bool is_lack_of_threads(const std::runtime_error& error) {
  return std::string_view(error.what()).find("pthread_create") != std::string_view::npos;
}

// Calls work(context), which is the call of this order. The context is the call's own: one that is
// bound to that of a body around it would be stopped half done by an exception of another body, and
// return as if all were done.
template <class Work>
void run(CallOrder& order, const Work& work) {
  tbb::task_group_context context(tbb::task_group_context::isolated);
  try {
    work(context);
  } catch (const std::runtime_error& error) {
    order.end();
    if (is_lack_of_threads(error)) throw OutOfThreads();
    throw;
  }
}

}  // namespace

namespace internal {

void run_ranges(std::size_t count, const std::function<void(std::size_t, std::size_t)>& range) {
  if (count == 0) return;
  if (most_threads() == 1) return range(0, count);
  using Range = tbb::blocked_range<std::size_t>;
  CallOrder order;
  const auto body = [&](const Range& part) {
    const CallOrder::Body inside(order);
    range(part.begin(), part.end());
  };
  run(order,
      [&](tbb::task_group_context& context) { tbb::parallel_for(Range(0, count), body, context); });
}

void run_both(const std::function<void()>& one, const std::function<void()>& other) {
  if (most_threads() == 1) {
    one();
    other();
    return;
  }
  CallOrder order;
  const auto body_of = [&order](const std::function<void()>& work) {
    return [&order, &work] {
      const CallOrder::Body inside(order);
      work();
    };
  };
  run(order, [&](tbb::task_group_context& context) {
    tbb::parallel_invoke(body_of(one), body_of(other), context);
  });
}

}  // namespace internal

namespace {

std::atomic<std::size_t> limits_to_one = 0;

}  // namespace

struct ThreadLimit::Control {
  explicit Control(std::size_t threads) {
    if (threads == 1) {
      ++limits_to_one;
    } else {
      limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }
  }
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;
  ~Control() {
    if (!limit) --limits_to_one;
  }
  std::optional<tbb::global_control> limit;
};

ThreadLimit::ThreadLimit(std::size_t threads)
    : control_(threads == 0 ? nullptr : std::make_unique<Control>(threads)) {}
ThreadLimit::~ThreadLimit() = default;

std::size_t most_threads() {
  if (limits_to_one > 0) return 1;
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

}  // namespace meshrepair
