// SPDX-License-Identifier: MIT
// The exit codes of every program, and the one place where exceptions become exit codes.
#pragma once

#include <array>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace meshrepair {

// What a script can gate on. `limit`, `output` and `internal` may be tried again; `input` and
// `no_solid` are final.
enum class ExitCode : int {
  done = 0,           // done; where a mesh was written, it holds every guarantee that was checked
  not_certified = 1,  // a mesh was written, but not every guarantee could be shown
  usage = 2,          // wrong usage: nothing was read
  input = 3,          // the input cannot be read
  limit = 4,          // a limit on time, memory or size was hit
  no_solid = 5,       // the input was read, but encloses nothing
  output = 6,         // the output cannot be written
  internal = 70,      // a bug of ours
  hung_up = 129,      // SIGHUP
  interrupted = 130,  // SIGINT
  terminated = 143,   // SIGTERM
};

// What each means to a user.
inline constexpr std::array<std::pair<ExitCode, std::string_view>, 11> kExitCodes = {{
    {ExitCode::done, "Done. A mesh that was written holds all guarantees, in the file."},
    {ExitCode::not_certified,
     "A mesh was written, but it does not hold all guarantees, or the mesh that was checked is not "
     "the boundary of a solid."},
    {ExitCode::usage, "The command line is wrong."},
    {ExitCode::input, "The input cannot be read."},
    {ExitCode::limit, "A limit on time, memory or size was reached."},
    {ExitCode::no_solid, "The input encloses nothing."},
    {ExitCode::output, "The output cannot be written."},
    {ExitCode::internal, "A bug."},
    {ExitCode::hung_up, "Hung up."},
    {ExitCode::interrupted, "Interrupted."},
    {ExitCode::terminated, "Terminated."},
}};

// Why a program ends early: its exit code and one line for the user, without the program's name.
struct Failure {
  ExitCode code = ExitCode::internal;
  std::string message;
  bool help_says_more = false;
};

// What the first signal received makes of the run; empty if there was none.
[[nodiscard]] std::optional<Failure> failure_of_signal();

// The family of base/error.h by type, std::bad_alloc to limit, the rest to internal. Once a signal
// was received every failure is that interruption: a cancelled read looks like a broken one. The
// message has no newline.
[[nodiscard]] Failure describe_failure(const std::exception_ptr& error);

// Throws OutputError if what was printed to std::cout or stdout could not be written.
void flush_standard_output();

// Runs `function` and returns its exit code. An exception becomes the exit code above and exactly
// one line
// "<program>: <message>" on stderr. flush_standard_output() is part of it.
[[nodiscard]] int run_guarded(std::string_view program, const std::function<ExitCode()>& function);

}  // namespace meshrepair
