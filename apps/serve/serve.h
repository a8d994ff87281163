// SPDX-License-Identifier: MIT
// meshrepair --serve: a page on this machine that hands meshes to the programs.
#pragma once

namespace meshrepair {

// Whether a command line asks for it: by its first argument.
[[nodiscard]] bool asks_to_serve(int argc, const char* const* argv);

// The whole of it, until a signal comes: returns the exit code.
[[nodiscard]] int serve(int argc, const char* const* argv);

}  // namespace meshrepair
