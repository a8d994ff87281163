// SPDX-License-Identifier: MIT
// Work on several threads. This is the only door to oneTBB: nothing else names it. A build with
// MESHREPAIR_PARALLEL=OFF has the same functions as plain loops, and needs no oneTBB.
//
// A call returns when all its work is done, or throws the first exception of a body; what has not
// begun by then is dropped. Throws OutOfThreads, too. Which thread does what is left to chance, so
// bodies write to places of their own: results are to be the same whatever the threads, and without
// any.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace meshrepair {

namespace internal {

// Calls range(first, last) for ranges that make up 0 ... count - 1, none of them empty.
void run_ranges(std::size_t count, const std::function<void(std::size_t, std::size_t)>& range);
void run_both(const std::function<void()>& one, const std::function<void()>& other);

}  // namespace internal

// Calls body(i) for each i below `count`.
template <class Body>
void parallel_for(std::size_t count, const Body& body) {
  // One call through a pointer for a range, not for each item.
  const auto range = [&body](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) body(i);
  };
  internal::run_ranges(count, std::ref(range));
}

// The number of tasks of `per_task` items each, the last of which may have fewer.
[[nodiscard]] constexpr std::size_t tasks_of(std::size_t count, std::size_t per_task) {
  return count / per_task + (count % per_task != 0 ? 1 : 0);
}

// Calls body(task, first, last) for each of these tasks: the items first ... last - 1 in one call.
template <class Body>
void parallel_tasks(std::size_t count, std::size_t per_task, const Body& body) {
  parallel_for(tasks_of(count, per_task), [&](std::size_t task) {
    const std::size_t first = task * per_task;
    body(task, first, std::min(per_task, count - first) + first);
  });
}

// What join(all, partial) makes of the results of reduce(first, last) for each of these tasks, from
// the first to the last: rounding, too, depends on `per_task` alone. Without items a Partial{}.
template <class Reduce, class Join>
auto parallel_reduce(std::size_t count, std::size_t per_task, const Reduce& reduce,
                     const Join& join) {
  using Partial = std::invoke_result_t<const Reduce&, std::size_t, std::size_t>;
  static_assert(!std::is_same_v<Partial, bool>, "threads would share the bytes of vector<bool>");
  std::vector<Partial> partials(tasks_of(count, per_task));
  parallel_tasks(count, per_task, [&](std::size_t task, std::size_t first, std::size_t last) {
    partials[task] = reduce(first, last);
  });
  Partial all{};
  for (Partial& partial : partials) join(all, std::exchange(partial, Partial{}));
  return all;
}

// Calls both.
template <class One, class Other>
void parallel_invoke(const One& one, const Other& other) {
  internal::run_both(std::ref(one), std::ref(other));
}

// Sorts, and leaves equal items in their order.
template <class Iterator, class Less>
void parallel_sort(Iterator first, Iterator last, const Less& less) {
  constexpr std::ptrdiff_t kSortedAlone = 1 << 14;  // a millisecond of work
  if (last - first <= kSortedAlone) return std::stable_sort(first, last, less);
  const Iterator middle = first + (last - first) / 2;
  parallel_invoke([&] { parallel_sort(first, middle, less); },
                  [&] { parallel_sort(middle, last, less); });
  std::inplace_merge(first, middle, last, less);
}

// While it lives, no more threads than this work, the caller's among them; 0: as many as the
// machine has. Of several the lowest counts.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::size_t threads);
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  ~ThreadLimit();

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

// How many threads may work now: 1 in a build without oneTBB.
[[nodiscard]] std::size_t most_threads();

}  // namespace meshrepair
