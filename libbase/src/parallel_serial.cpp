// SPDX-License-Identifier: MIT
// In place of parallel.cpp where oneTBB is not wanted: one thread does it all, in order.
#include <base/parallel.h>

namespace meshrepair {
namespace internal {

void run_ranges(std::size_t count, const std::function<void(std::size_t, std::size_t)>& range) {
  if (count > 0) range(0, count);
}

void run_both(const std::function<void()>& one, const std::function<void()>& other) {
  one();
  other();
}

}  // namespace internal

struct ThreadLimit::Control {};
ThreadLimit::ThreadLimit(std::size_t /*threads*/) {}
ThreadLimit::~ThreadLimit() = default;

std::size_t most_threads() { return 1; }

}  // namespace meshrepair
