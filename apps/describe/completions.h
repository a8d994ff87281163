// SPDX-License-Identifier: MIT
// What completes the command line of a program, in the words of each shell: its options, and where
// a value is one of a few names or a file, these.
#pragma once

#include <string>

#include "describe/command_facts.h"

namespace meshrepair {

// For share/bash-completion/completions; needs the package bash-completion.
[[nodiscard]] std::string bash_completion(const CommandFacts& command);
// For share/zsh/site-functions, as _PROGRAM.
[[nodiscard]] std::string zsh_completion(const CommandFacts& command);
// For share/fish/vendor_completions.d, as PROGRAM.fish.
[[nodiscard]] std::string fish_completion(const CommandFacts& command);

}  // namespace meshrepair
