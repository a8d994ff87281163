#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sys/resource.h>

#include <bsp/error.h>
#include <repair/stage_meter.h>

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

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

// Linux keeps the peak of the resident memory and resets it on request, so that each stage has its
// own. Where that is not allowed the peak is that of the process so far.
void reset_peak() {
  if (const File file{std::fopen("/proc/self/clear_refs", "w")}) std::fputs("5", file.get());
}

std::size_t peak_bytes() {
  if (const File file{std::fopen("/proc/self/status", "r")}) {
    char line[256];
    unsigned long kilobytes = 0;
    while (std::fgets(line, sizeof line, file.get()) != nullptr) {
      if (std::sscanf(line, "VmHWM: %lu kB", &kilobytes) == 1) return kilobytes * 1024;
    }
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

void StageMeter::begin(std::string_view name) {
  end();
  if (progress_ != nullptr) {
    if (progress_->cancelled()) throw Cancelled();
    progress_->stage(name);
  }
  stages_.push_back({std::string(name), 0, 0, 0});
  reset_peak();
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
