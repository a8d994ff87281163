// SPDX-License-Identifier: MIT
#include "bench_cases.h"

#include <cstdio>
#include <fstream>

#include <base/stage_meter.h>
#include <mesh/soup_io.h>

#include "generated_inputs.h"

namespace meshrepair::bench {
std::vector<Case> cases_of(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) {
    names = {"spheres:1000", "spheres:10000", "spheres:100000",
             "cubes:100",    "cubes:1000",    "noisy:20000"};
  }
  std::vector<Case> cases;
  cases.reserve(names.size());
  for (const std::string& name : names) {
    cases.push_back({name, is_generated_mesh(name) ? generated_mesh(name) : read_soup(name).soup});
  }
  return cases;
}

void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

Measurement measure(const std::function<void()>& work) {
  forget_peak();
  std::vector<StageReport> stages;
  {
    StageMeter meter(stages, nullptr);
    meter.begin("before");
    meter.begin("work");
    work();
  }
  const std::size_t before = stages[0].peak_bytes;
  const std::size_t peak = stages[1].peak_bytes;
  return {stages[1].cpu_seconds, peak > before ? peak - before : 0};
}

void print_header(const std::string& what) {
  std::printf("%s\n%-44s %10s %10s %10s\n", what.c_str(), "input", "triangles", "us/tri",
              "bytes/tri");
}

void print_row(const Case& input, const Measurement& m, const std::string& note) {
  const auto n = static_cast<double>(input.soup.triangles.size());
  std::printf("%-44s %10zu %10.2f %10.0f  %s\n", input.name.c_str(), input.soup.triangles.size(),
              1e6 * m.cpu_seconds / n, static_cast<double>(m.peak_bytes) / n, note.c_str());
  std::fflush(stdout);
}

}  // namespace meshrepair::bench
