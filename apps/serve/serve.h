// SPDX-License-Identifier: MIT
// meshrepair --serve: a page on this machine that hands meshes to the programs.
#pragma once

#include <string_view>

namespace meshrepair {

inline constexpr std::string_view kServeFlag = "--serve";

// Whether a command line asks for it: by its first argument.
[[nodiscard]] inline bool asks_to_serve(int argc, const char* const* argv) {
  return argc > 1 && argv[1] == kServeFlag;
}

// The whole of it, until a signal comes: returns the exit code.
[[nodiscard]] int serve(int argc, const char* const* argv);

}  // namespace meshrepair
