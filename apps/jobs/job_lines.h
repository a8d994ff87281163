// SPDX-License-Identifier: MIT
// What the worker of many jobs is told, one JSON object in each line:
//
//   {"id": 7, "in": "broken.stl", "out": "repaired.stl", "options": ["--for", "print"]}
//   {"cancel": 7, "grace": 3}
//
//   id       any value; the answer has the same; numbers of more than 64 bits are rounded
//   in, out  names of files
//   options  of meshrepair; may be left out
//   cancel   the id of jobs to end
//   grace    seconds that they have to end by themselves, until they are killed; may be left out
//
// JSON is UTF-8, and names of files are bytes: instead of a text, a name or an option may be
// {"base64": "..."}.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "report/json.h"

namespace meshrepair {

struct Job {
  Json id;
  std::string in;
  std::string out;
  std::vector<std::string> options;
};

struct Cancellation {
  Json id;
  double grace = 3;
};

// A line that is neither.
struct WrongLine {
  Json id;  // null where it says none
  std::string why;
};

using JobLine = std::variant<Job, Cancellation, WrongLine>;

// Never throws.
[[nodiscard]] JobLine read_job_line(std::string_view line);

}  // namespace meshrepair
