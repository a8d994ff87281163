// SPDX-License-Identifier: MIT
// --for: options that belong together for what a solid is to be used for.
#pragma once

#include <string>
#include <vector>

#include "options/command_line.h"

namespace meshrepair {

// What the command line asks for.
struct Purpose {
  std::string name;                     // empty: none
  std::vector<std::string> options;     // that come of it: "--min-part 1e-6"
  std::vector<std::string> overridden;  // that were given otherwise
};

// Before all options that a purpose sets, as options act in the order in which they are added. Each
// that the command line does not give itself gets the value that the purpose has for it.
void add_purpose_option(CommandLine& app, Purpose& purpose);

}  // namespace meshrepair
