// SPDX-License-Identifier: MIT
// Options that programs had once, and what does their work.
#pragma once

#include <string>

namespace meshrepair {

class CommandLine;

// How options are spelled: --drop all, or drop="all".
enum class Spelling { command_line, keywords };

// Why an option "--name" is none any more, and what to use in its place; empty: it is one, or never
// was.
[[nodiscard]] std::string why_removed(const CommandLine& line, const std::string& name,
                                      Spelling spelling);

}  // namespace meshrepair
