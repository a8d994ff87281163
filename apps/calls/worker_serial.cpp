// SPDX-License-Identifier: MIT
// In place of worker.cpp where there are no threads: the work lets its caller look.
#include <chrono>
#include <exception>
#include <utility>

#include "calls/plain_locale.h"
#include "calls/worker.h"

namespace meshrepair {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenLooks(50);

// Of the call that works.
struct Watch {
  const std::function<void()>& look;
  Clock::time_point last;
  std::exception_ptr raised;  // by `look`, which is called no more then
};

Watch* watch_of_call = nullptr;

}  // namespace

void let_look() {
  Watch* const watch = watch_of_call;
  if (watch == nullptr || watch->raised || Clock::now() - watch->last < kBetweenLooks) return;
  try {
    watch->look();
  } catch (...) {
    watch->raised = std::current_exception();
  }
  watch->last = Clock::now();
}

void run_watched(const std::function<void()>& work, const std::function<void()>& look) {
  const PlainLocale plain;
  Watch watch{look, Clock::now(), nullptr};
  Watch* const before = std::exchange(watch_of_call, &watch);
  std::exception_ptr failure;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  watch_of_call = before;
  if (watch.raised) failure = watch.raised;
  if (failure) std::rethrow_exception(failure);
}

}  // namespace meshrepair
