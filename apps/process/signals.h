// SPDX-License-Identifier: MIT
// How programs end when they are asked to: politely first, at once if asked twice.
#pragma once

namespace meshrepair {

// SIGHUP, SIGINT and SIGTERM: the first one is noted (see received_signal) and the work is expected
// to stop at the next question of cancelled(); the second one removes the unfinished output
// file, restores the terminal and ends the process at once with 128 and its number. SIGPIPE and
// SIGXFSZ are ignored: a closed pipe and a limit on the size of files are then write errors like
// any other. A signal that was ignored when the program started (nohup) stays ignored.
void install_signal_handlers();

// The same for this signal, too.
void install_signal_handler(int number);

// The number of the first signal received, or 0.
[[nodiscard]] int received_signal() noexcept;

}  // namespace meshrepair
