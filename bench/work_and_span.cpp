// SPDX-License-Identifier: MIT
// How much would more cores bring? This is `meshrepair` itself, with a door to threads of its own
// that runs each task by itself, one after the other, and takes its time. Work is all CPU time;
// span is the longest chain, which no number of cores makes shorter: what runs outside of tasks,
// and of tasks that run at once the longest one. With p cores a scheduler that leaves none idle
// while there is a task takes at most span + (work - span) / p (Brent 1974).
//
// Takes the arguments of `meshrepair`, and prints a table by stages at the end.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include <base/error.h>
#include <base/parallel.h>
#include <base/stage_meter.h>

namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// By how much the chain is shorter than the work, of what is measured now.
double saved_now = 0;

// The longest chain of a piece of work.
template <class Work>
double span_of(const Work& work) {
  const double saved_before = std::exchange(saved_now, 0);
  const double start = cpu_seconds();
  work();
  const double span = cpu_seconds() - start - saved_now;
  saved_now = saved_before;
  return span;
}

struct StageCost {
  std::string name;
  double work = 0;
  double span = 0;
};

// The stages of the program, and what lies between them.
class Table {
 public:
  ~Table() {
    close();
    print();
  }
  void open(std::string name) {
    close();
    name_ = std::move(name);
  }
  void close() {
    const double now = cpu_seconds();
    StageCost cost = {std::exchange(name_, "between"), now - start_, now - start_ - saved_now};
    const auto known = std::find_if(costs_.begin(), costs_.end(),
                                    [&](const StageCost& c) { return c.name == cost.name; });
    if (known == costs_.end()) {
      costs_.push_back(cost);
    } else {
      known->work += cost.work;
      known->span += cost.span;
    }
    saved_now = 0;
    start_ = cpu_seconds();
  }

 private:
  void print() {
    std::fprintf(stderr, "%-10s %9s %9s   speed-up at least with 2, 4, 8, 16, 64 cores\n", "stage",
                 "work s", "span s");
    StageCost all = {"all", 0, 0};
    for (const StageCost& cost : costs_) {
      print(cost);
      all.work += cost.work;
      all.span += cost.span;
    }
    print(all);
  }
  static void print(const StageCost& cost) {
    std::fprintf(stderr, "%-10s %9.3f %9.3f  ", cost.name.c_str(), cost.work, cost.span);
    for (const double cores : {2.0, 4.0, 8.0, 16.0, 64.0}) {
      std::fprintf(stderr, " %6.2f", cost.work / (cost.span + (cost.work - cost.span) / cores));
    }
    std::fprintf(stderr, "\n");
  }

  std::vector<StageCost> costs_;
  std::string name_ = "between";
  double start_ = cpu_seconds();
};

Table table;
const meshrepair::StageMeter* outermost = nullptr;  // a repair within a stage has stages of its own

}  // namespace

namespace meshrepair {
namespace internal {

void run_ranges(std::size_t count, const std::function<void(std::size_t, std::size_t)>& range) {
  // Threads may share a list of short items in pieces as small as these.
  constexpr std::size_t kPieces = 1024;
  const std::size_t piece = std::max<std::size_t>(1, count / kPieces);
  double sum = 0, longest = 0;
  const double start = cpu_seconds();
  for (std::size_t first = 0; first < count; first += piece) {
    const double span = span_of([&] { range(first, std::min(count, first + piece)); });
    longest = std::max(longest, span);
  }
  sum = cpu_seconds() - start;
  saved_now += sum - longest;
}

void run_both(const std::function<void()>& one, const std::function<void()>& other) {
  const double start = cpu_seconds();
  const double longest = std::max(span_of(one), span_of(other));
  saved_now += cpu_seconds() - start - longest;
}

}  // namespace internal

struct ThreadLimit::Control {};
ThreadLimit::ThreadLimit(std::size_t /*threads*/) {}
ThreadLimit::~ThreadLimit() = default;

std::size_t most_threads() { return 1; }

void StageMeter::begin(std::string_view name) {
  end();
  if (progress_ != nullptr) {
    if (progress_->cancelled()) throw Cancelled();
    progress_->stage(name);
  }
  stages_.push_back({std::string(name), 0, 0, 0});
  running_ = true;
  if (outermost != nullptr) return;
  outermost = this;
  table.open(std::string(name));
}

void StageMeter::end() noexcept {
  if (!running_) return;
  running_ = false;
  if (outermost != this) return;
  outermost = nullptr;
  table.close();
}

}  // namespace meshrepair
