// SPDX-License-Identifier: MIT
// --require: conditions on the result, each on a number of the report.
//
//   --require "parts=same, volume=1%, moved<=0.01, lost-area<=0.1%, triangles<=1.5x"
//   --require policy.json     {"parts": "same", "volume": "1%", "moved": "<=0.01"}
#pragma once

#include <string>
#include <vector>

#include "options/command_line.h"
#include "report/findings.h"

namespace meshrepair {

struct Requirement {
  enum class Relation { equal, at_most, at_least };
  enum class Kind {
    number,
    percent,  // a change from the input, or a share: 0.01 for 1%
    ratio,    // of the number of the input
    same      // as in the input
  };

  std::string key;  // a short name, or the path of a number in the report: "holes.closed"
  Relation relation = Relation::equal;
  Kind kind = Kind::number;
  double bound = 0;  // of `same`: 1
  std::string text;  // as it was given
};

// Throws UsageError where it is none, or its key or bound makes no sense.
[[nodiscard]] Requirement parse_requirement(const std::string& text);

// --require. Reads files as they are named.
void add_require_option(CommandLine& app, std::vector<Requirement>& requirements);

// Whether one asks for the section "distance".
[[nodiscard]] bool asks_for_distance(const std::vector<Requirement>& requirements);

// Fills Findings::required and Findings::not_met. To be called when all else is known, before the
// output is written.
void judge_requirements(const std::vector<Requirement>& requirements, Findings& findings);

}  // namespace meshrepair
