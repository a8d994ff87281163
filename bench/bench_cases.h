// SPDX-License-Identifier: MIT
// The inputs that all benchmarks share, and how they measure.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::bench {

struct Case {
  std::string name;
  TriangleSoup soup;
};

// The inputs that a command line asks for: each argument is a mesh file or the name of a generated
// mesh, as "spheres:N" (generated_inputs.h). Without arguments a small set of these.
[[nodiscard]] std::vector<Case> cases_of(int argc, char** argv);

struct Measurement {
  double cpu_seconds = 0;
  std::size_t peak_bytes = 0;  // above what was resident before
};

// So that what follows has a peak of its own. Only Linux can forget the peak so far; elsewhere it
// stays.
void forget_peak();

// Runs `work` once; the peak is forgotten before.
[[nodiscard]] Measurement measure(const std::function<void()>& work);

// One line of the table that every benchmark prints: microseconds and bytes per input triangle, and
// whatever else it has to say.
void print_header(const std::string& what);
void print_row(const Case& input, const Measurement& m, const std::string& note);

// Prepares with `prepare`, measures `work`, prints a row with `note`; for each case.
template <class State>
void run_cases(int argc, char** argv, const std::string& what,
               const std::function<State(const TriangleSoup&)>& prepare,
               const std::function<std::string(State&)>& work) {
  print_header(what);
  for (const Case& input : cases_of(argc, argv)) {
    State state = prepare(input.soup);
    std::string note;
    const Measurement m = measure([&] { note = work(state); });
    print_row(input, m, note);
  }
}

}  // namespace meshrepair::bench
