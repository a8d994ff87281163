// SPDX-License-Identifier: MIT
// How long does a whole repair take, stage by stage? CPU microseconds, and the peak of the
// process's resident memory, per input triangle.
#include <cstdio>

#include <base/error.h>
#include <repair/repair.h>

#include "bench_cases.h"

using namespace meshrepair;

int main(int argc, char** argv) {
  for (const bench::Case& input : bench::cases_of(argc, argv)) {
    RepairReport report;
    bench::forget_peak();
    try {
      (void)repair(input.soup, {}, report);
    } catch (const Error& error) {
      std::printf("%s: %s\n", input.name.c_str(), error.what());
      continue;
    }
    const auto n = static_cast<double>(input.soup.triangles.size());
    std::printf("%s: %zu triangles in, %zu out\n", input.name.c_str(), input.soup.triangles.size(),
                report.output.triangles);
    double cpu = 0;
    std::size_t peak = 0;
    for (const StageReport& stage : report.stages) {
      std::printf("  %-8s %8.2f us/tri %8.0f bytes/tri\n", stage.name.c_str(),
                  1e6 * stage.cpu_seconds / n, static_cast<double>(stage.peak_bytes) / n);
      cpu += stage.cpu_seconds;
      peak = std::max(peak, stage.peak_bytes);
    }
    std::printf("  %-8s %8.2f us/tri %8.0f bytes/tri\n", "all", 1e6 * cpu / n,
                static_cast<double>(peak) / n);
  }
  return 0;
}
