// SPDX-License-Identifier: MIT
// Which pictures the terminal of this process can draw.
#pragma once

#include <base/progress.h>

namespace meshrepair {

enum class TerminalPictures { none, sixel, kitty };

// Asks the terminal that stderr goes to, and waits up to a second for its answer. None where stderr
// is no terminal, or this process is in its background. What a user types meanwhile may be lost.
// Throws Cancelled.
[[nodiscard]] TerminalPictures ask_terminal_for_pictures(ProgressObserver& progress);

}  // namespace meshrepair
