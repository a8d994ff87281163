// SPDX-License-Identifier: MIT
// Runs that go on from where an earlier one was interrupted.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "options/command_line.h"
#include "program/program.h"

namespace meshrepair {

class StateStore;

// Sets `folder` to the value of --resume.
void add_resume_option(CommandLine& app, std::string& folder);

// False only where it is known not to: of an option that is not known it is taken for granted.
[[nodiscard]] bool changes_results(const CommandOption& option);

// All that `app` was asked for that changes what a repair decides: not IN, how the program runs and
// tells, and what it draws, nor these options. Words of a command line, each with a line feed.
[[nodiscard]] std::string options_of_results(const CommandLine& app,
                                             const std::vector<std::string>& others);

// Calls body(store): with a folder that keeps states until the body has ended well, or there is no
// solid; without a name of a folder, with null. The report names the states that were there.
void run_resumable(const std::string& folder, const CommandLine& app, Run& run,
                   const std::function<void(StateStore*)>& body);

}  // namespace meshrepair
