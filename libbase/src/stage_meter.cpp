// SPDX-License-Identifier: MIT
#include <chrono>
#include <sys/resource.h>

#include <base/block_source.h>
#include <base/error.h>
#include <base/stage_meter.h>

namespace meshrepair {
namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double seconds_of(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

std::size_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

void StageMeter::begin(std::string_view name) {
  end();
  return_free_memory();
  if (progress_ != nullptr) {
    if (progress_->cancelled()) throw Cancelled();
    progress_->stage(name);
  }
  stages_.push_back({std::string(name), 0, 0, 0});
  wall_start_ = wall_seconds();
  cpu_start_ = cpu_seconds();
  running_ = true;
}

void StageMeter::end() noexcept {
  if (!running_) return;
  running_ = false;
  StageReport& stage = stages_.back();
  stage.seconds = wall_seconds() - wall_start_;
  stage.cpu_seconds = cpu_seconds() - cpu_start_;
  stage.peak_bytes = peak_bytes();
}

}  // namespace meshrepair
