// SPDX-License-Identifier: MIT
#include "process/progress_bar.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>
#include <spdlog/logger.h>

#include <base/error.h>
#include <base/internal/system.h>

#include "process/memory_limit.h"
#include "process/signals.h"
#include "terminal/logging.h"

namespace meshrepair {
namespace {

constexpr double kSecondsBetweenDrawings = 0.1;
constexpr double kSecondsBetweenQuestions = 0.01;

double seconds_between(std::chrono::steady_clock::time_point from,
                       std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

double clamp_share(double share) {
  return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
}

int percent_of(double share) { return static_cast<int>(clamp_share(share) * 100); }

int columns_of(std::FILE* terminal) {
  constexpr int kUsual = 80;
  const int columns = internal::terminal_columns(fileno(terminal));
  return columns > 0 ? columns : kUsual;
}

}  // namespace

std::string progress_line(std::string_view stage, double share, double seconds, int columns) {
  const double clamped = clamp_share(share);
  const int percent = percent_of(share);
  std::string line = fmt::format("{:<12} {:>3}% ", stage, percent);
  const std::string end = fmt::format(" {:.1f} s", seconds);
  const int room = columns - static_cast<int>(line.size() + end.size()) - 2;
  if (room >= 10) {
    const auto width = static_cast<std::size_t>(std::min(room, 40));
    const auto filled = static_cast<std::size_t>(clamped * static_cast<double>(width));
    line += '[' + std::string(filled, '=') + std::string(width - filled, ' ') + ']';
  }
  line += end;
  return line.substr(0, static_cast<std::size_t>(std::max(columns, 0)));
}

ProgressBar::ProgressBar(const Options& options)
    : options_(options), start_(Clock::now()), stage_start_(start_), last_drawn_(start_) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::stage(std::string_view name) {
  end_stage();
  stage_start_ = Clock::now();
  {
    const std::scoped_lock lock(where_mutex_);
    stage_ = name;
    share_ = 0;
  }
  logger().debug("{} ...", stage_);
  told_percent_ = -1;
  tell();
  draw();
}

void ProgressBar::advance(double share) {
  {
    const std::scoped_lock lock(where_mutex_);
    share_ = share;
  }
  tell();
  draw();
}

bool ProgressBar::cancelled() {
  if (received_signal() != 0) {
    work_is_ending_ = true;
    return true;
  }
  const Clock::time_point now = Clock::now();
  if (seconds_between(last_question_, now) > kSecondsBetweenQuestions) {
    last_question_ = now;
    if (const auto limit = limit_reached()) {
      work_is_ending_ = true;
      throw LimitError(*limit);
    }
  }
  draw();
  return false;
}

std::optional<Failure> ProgressBar::reason_to_stop() const {
  if (auto signal = failure_of_signal()) return signal;
  if (auto limit = limit_reached()) return Failure{ExitCode::limit, std::move(*limit)};
  return std::nullopt;
}

std::optional<std::string> ProgressBar::limit_reached() const {
  if (options_.time_limit > 0 && seconds() > options_.time_limit) {
    return fmt::format("time limit of {:g} s reached {}", options_.time_limit, where());
  }
  const internal::ProcessMemory now = internal::process_memory();
  const std::uint64_t memory = options_.spills ? now.own : now.resident;
  if (options_.memory_limit > 0 && memory > options_.memory_limit) {
    return out_of_memory();
  }
  return std::nullopt;
}

std::string ProgressBar::out_of_memory() const {
  if (options_.memory_limit == 0) return "out of memory " + where();
  return fmt::format("memory limit of {} reached {}", memory_text(options_.memory_limit), where());
}

LimitError ProgressBar::out_of_threads() const {
  const std::string what = "the system gives no further thread; --threads 1 needs none";
  if (options_.memory_limit == 0) return LimitError(what + ", " + where());
  return LimitError(out_of_memory() + ": " + what);
}

std::string ProgressBar::where() const {
  const std::scoped_lock lock(where_mutex_);
  if (stage_.empty()) {
    return stages_.empty() ? "before the first stage"
                           : fmt::format("after stage '{}'", stages_.back().name);
  }
  return fmt::format("in stage '{}', {} % done", stage_, percent_of(share_));
}

void ProgressBar::finish() {
  end_stage();
  clear();
}

double ProgressBar::seconds() const { return seconds_between(start_, Clock::now()); }

void ProgressBar::end_stage() {
  if (stage_.empty()) return;
  const double seconds = seconds_between(stage_start_, Clock::now());
  const std::scoped_lock lock(where_mutex_);
  const auto known = std::find_if(stages_.begin(), stages_.end(),
                                  [&](const StageTime& time) { return time.name == stage_; });
  if (known != stages_.end()) {
    known->seconds += seconds;
  } else {
    stages_.push_back({stage_, seconds});
  }
  logger().info("{}: {:.3f} s", stage_, seconds);
  stage_.clear();
}

// Whoever listens no longer is no reason to stop.
void ProgressBar::tell() {
  const int percent = percent_of(share_);
  if (options_.told < 0 || percent <= told_percent_) return;
  told_percent_ = percent;
  const std::string line = fmt::format("{} {}\n", stage_, percent);
  (void)internal::write_some(options_.told, line.data(), line.size());
}

void ProgressBar::draw() {
  if (!options_.draw || stage_.empty()) return;
  const Clock::time_point now = Clock::now();
  if (seconds_between(start_, now) < options_.delay) return;
  if (line_is_drawn_ && seconds_between(last_drawn_, now) < kSecondsBetweenDrawings) return;
  // One column is left free: a full line would wrap on some terminals.
  const std::string line = progress_line(stage_, share_, seconds_between(stage_start_, now),
                                         columns_of(options_.terminal) - 1);
  fmt::print(options_.terminal, "\r{}\x1b[K", line);
  std::fflush(options_.terminal);
  line_is_drawn_ = true;
  last_drawn_ = now;
}

void ProgressBar::clear() {
  if (!line_is_drawn_) return;
  std::fputs("\r\x1b[K", options_.terminal);
  std::fflush(options_.terminal);
  line_is_drawn_ = false;
}

}  // namespace meshrepair
