// SPDX-License-Identifier: MIT
// meshrepair-blocks plan, run and join: a mesh repaired block by block, on many machines.
#pragma once

namespace meshrepair {

// Each is a program of its own, whose arguments follow the verb. They return the exit code.
[[nodiscard]] int plan_blocks(int argc, const char* const* argv);
[[nodiscard]] int run_block(int argc, const char* const* argv);
[[nodiscard]] int join_blocks(int argc, const char* const* argv);

}  // namespace meshrepair
