// SPDX-License-Identifier: MIT
// The manual page of a program, in the macros of man(7).
#pragma once

#include <string>

#include "describe/command_facts.h"

namespace meshrepair {

[[nodiscard]] std::string man_page(const CommandFacts& command);

}  // namespace meshrepair
