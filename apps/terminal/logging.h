// SPDX-License-Identifier: MIT
// What a program says on stderr besides its one error line. Standard output is for data alone.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace spdlog {
class logger;
}

namespace meshrepair {

enum class Verbosity {
  quiet,    // errors only
  normal,   // warnings, and the summary at the end
  verbose,  // also what each step does
};

// What warnings and steps are told to; at first they go nowhere.
[[nodiscard]] spdlog::logger& logger();
// Before any thread.
void set_logger(std::shared_ptr<spdlog::logger> logger);

// Makes the logger write "<program>: <level>: <text>" to stderr, in colours only if
// stderr is a terminal and NO_COLOR is not set.
void set_up_logging(const std::string& program, Verbosity verbosity);

// Prints lines for the user to stderr as they are, unless the verbosity is quiet.
void print_summary(std::string_view lines);

// True if stderr is a terminal that understands control sequences.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace meshrepair
