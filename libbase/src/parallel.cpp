#include <stdexcept>
#include <string_view>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_group.h>

#include <base/error.h>
#include <base/parallel.h>

namespace meshrepair {
namespace {

// oneTBB has no type for it.
bool is_lack_of_threads(const std::runtime_error& error) {
  return std::string_view(error.what()).find("pthread_create") != std::string_view::npos;
}

// Calls work(context). The context is the call's own: one that is bound to that of a body around it
// would be stopped half done by an exception of another body, and return as if all were done.
template <class Work>
void run(const Work& work) {
  tbb::task_group_context context(tbb::task_group_context::isolated);
  try {
    work(context);
  } catch (const std::runtime_error& error) {
    if (is_lack_of_threads(error)) throw OutOfThreads();
    throw;
  }
}

}  // namespace

namespace internal {

void run_ranges(std::size_t count, const std::function<void(std::size_t, std::size_t)>& range) {
  using Range = tbb::blocked_range<std::size_t>;
  const auto body = [&](const Range& part) { range(part.begin(), part.end()); };
  run([&](tbb::task_group_context& context) { tbb::parallel_for(Range(0, count), body, context); });
}

void run_both(const std::function<void()>& one, const std::function<void()>& other) {
  run([&](tbb::task_group_context& context) { tbb::parallel_invoke(one, other, context); });
}

}  // namespace internal

struct ThreadLimit::Control {
  explicit Control(std::size_t threads)
      : limit(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(std::size_t threads)
    : control_(threads == 0 ? nullptr : std::make_unique<Control>(threads)) {}
ThreadLimit::~ThreadLimit() = default;

std::size_t most_threads() {
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

}  // namespace meshrepair
