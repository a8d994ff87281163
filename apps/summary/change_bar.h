// SPDX-License-Identifier: MIT
// What became of the triangles of the input, as a bar of characters.
#pragma once

#include <string>

#include <repair/repair.h>

namespace meshrepair {

// A line for the summary: a bar with a character for each 2.5 % of the triangles, and what the
// characters mean. A share that is not zero has one at least. Empty where there were no triangles.
[[nodiscard]] std::string change_bar(const RepairReport& repair);

}  // namespace meshrepair
