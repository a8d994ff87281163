// SPDX-License-Identifier: MIT
// meshrepair --jobs-from FILE: one start for many small meshes.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "program/program.h"

namespace meshrepair {

inline constexpr std::string_view kJobsFlag = "--jobs-from";

// Whether the command line asks for many jobs: by its first argument.
[[nodiscard]] inline bool asks_for_jobs(int argc, const char* const* argv) {
  if (argc < 2) return false;
  const std::string_view first = argv[1];
  return first == kJobsFlag || first.starts_with(std::string(kJobsFlag) + "=");
}

// Reads jobs, one in each line, and prints their answers. Each is worked off by `run`, in a copy of
// this process, with the command line of a job: the other options of this one, those of the job, IN
// and OUT. `program` is what `run` runs, and has all its own options. Returns the exit code.
[[nodiscard]] int work_off_jobs(int argc, const char* const* argv, Program& program,
                                const std::function<int(int, const char* const*)>& run);

}  // namespace meshrepair
