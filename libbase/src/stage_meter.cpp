// SPDX-License-Identifier: MIT
#include <chrono>

#include <base/block_source.h>
#include <base/error.h>
#include <base/internal/system.h>
#include <base/stage_meter.h>

namespace meshrepair {
namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
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
  cpu_start_ = internal::cpu_seconds();
  running_ = true;
}

void StageMeter::end() noexcept {
  if (!running_) return;
  running_ = false;
  StageReport& stage = stages_.back();
  stage.seconds = wall_seconds() - wall_start_;
  stage.cpu_seconds = internal::cpu_seconds() - cpu_start_;
  stage.peak_bytes = internal::peak_memory();
}

}  // namespace meshrepair
