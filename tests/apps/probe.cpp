// SPDX-License-Identifier: MIT
// A program that does nothing but end in one of the ways in which programs end: what is tested with
// it is the frame that all programs share.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <new>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <base/assert.h>
#include <base/error.h>
#include <base/parallel.h>

#include "program/program.h"

namespace meshrepair {
namespace {

ExitCode fail(const std::string& how) {
  if (how == "usage") throw UsageError("x.txt: unknown format");
  if (how == "input") throw InputError("x.stl: is empty");
  if (how == "limit") throw LimitError("more than 5 triangles");
  if (how == "memory") throw std::bad_alloc();
  if (how == "no_solid") throw NoSolidError("x.stl: encloses nothing");
  if (how == "output") throw OutputError("x.stl: cannot be written: No space left on device");
  if (how == "cancelled") throw Cancelled();
  if (how == "assert") MESHREPAIR_ASSERT(how.empty());
  if (how == "exception") throw std::runtime_error("first line\nsecond line");
  if (how == "threads_gone") throw OutOfThreads();
  if (how == "unknown") throw 1;
  return how == "not_certified" ? ExitCode::not_certified : ExitCode::done;
}

// Two signals, with nothing between them: how long the first one takes to have an effect does not
// matter.
ExitCode take_two_signals() {
  std::raise(SIGINT);
  std::raise(SIGTERM);
  return ExitCode::done;
}

// Until it is told to stop, and at most ten minutes.
ExitCode work(ProgressBar& progress, bool deaf) {
  progress.stage("waiting");
  std::puts("working");
  std::fflush(stdout);
  for (int i = 0; i < 60000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    progress.advance(i / 60000.0);
    if (!deaf && progress.cancelled()) throw Cancelled();
  }
  return ExitCode::done;
}

// Takes memory in pieces, and uses it, until it is told to stop.
ExitCode hoard(ProgressBar& progress) {
  progress.stage("hoarding");
  std::vector<std::vector<char>> pieces;
  for (int i = 0; i < 4096; ++i) {
    pieces.emplace_back(std::size_t{1} << 20, 'x');
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (progress.cancelled()) throw Cancelled();
  }
  return ExitCode::done;
}

ExitCode gulp(ProgressBar& progress) {
  progress.stage("gulping");
  const std::vector<char> much(std::size_t{1} << 30, 'x');
  return much.back() == 'x' ? ExitCode::done : ExitCode::not_certified;
}

ExitCode probe(const std::string& what, Run& run) {
  run.report.set_input({{"path", what}});
  if (what == "work") return work(run.progress, false);
  if (what == "deaf") return work(run.progress, true);
  if (what == "two_signals") return take_two_signals();
  if (what == "hoard") return hoard(run.progress);
  if (what == "gulp") return gulp(run.progress);
  if (what == "stdin") {
    std::puts("working");
    std::fflush(stdout);
    char byte = 0;
    if (read(STDIN_FILENO, &byte, 1) < 0) throw InputError("standard input: interrupted");
    return ExitCode::done;
  }
  if (what == "threads") run.report.set_section("probe", {{"threads", most_threads()}});
  if (what == "print") std::puts("data");
  return fail(what);
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  std::string what;
  meshrepair::Program program("probe", "Ends in the way that it is told.", "  probe done\n");
  program.command_line().add_option("WHAT", what, "How to end")->required();
  return program.run(argc, argv,
                     [&](meshrepair::Run& run) { return meshrepair::probe(what, run); });
}
