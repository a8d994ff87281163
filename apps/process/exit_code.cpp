// SPDX-License-Identifier: MIT
#include "process/exit_code.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>

#include <base/error.h>
#include <base/internal/system.h>

#include "process/signals.h"

namespace meshrepair {
namespace {

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n' && !line.empty() && line.back() != ' ') line += ' ';
    if (c != '\n' && c != '\r') line += c;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

Failure describe_exception(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const ValueError& e) {
    return {ExitCode::usage, e.what()};
  } catch (const UsageError& e) {
    return {ExitCode::usage, e.what(), true};
  } catch (const InputError& e) {
    return {ExitCode::input, e.what()};
  } catch (const LimitError& e) {
    return {ExitCode::limit, e.what()};
  } catch (const NoSolidError& e) {
    return {ExitCode::no_solid, e.what()};
  } catch (const OutputError& e) {
    return {ExitCode::output, e.what()};
  } catch (const Cancelled& e) {
    return {ExitCode::interrupted, e.what()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::limit, "out of memory"};
  } catch (const std::exception& e) {
    return {ExitCode::internal, e.what()};
  } catch (...) {
    return {ExitCode::internal, "an exception of unknown type"};
  }
}

}  // namespace

std::optional<Failure> failure_of_signal() {
  switch (received_signal()) {
    case internal::kHangUp:
      return Failure{ExitCode::hung_up, "hung up"};
    case internal::kInterrupt:
      return Failure{ExitCode::interrupted, "interrupted"};
    case internal::kTerminate:
      return Failure{ExitCode::terminated, "terminated"};
    default:
      return std::nullopt;
  }
}

Failure describe_failure(const std::exception_ptr& error) {
  if (auto interruption = failure_of_signal()) return *interruption;
  Failure failure = describe_exception(error);
  failure.message = one_line(failure.message);
  return failure;
}

void flush_standard_output() {
  errno = 0;
  std::cout.flush();
  if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    const std::string reason = errno != 0 ? std::strerror(errno) : "write error";
    throw OutputError("standard output: cannot be written: " + reason);
  }
}

int run_guarded(std::string_view program, const std::function<ExitCode()>& function) {
  try {
    const ExitCode code = function();
    flush_standard_output();
    return static_cast<int>(code);
  } catch (...) {
    const Failure failure = describe_failure(std::current_exception());
    std::string line = std::string(program) + ": " + failure.message;
    if (failure.help_says_more) line += " (try '" + std::string(program) + " --help')";
    line += '\n';
    std::fputs(line.c_str(), stderr);
    return static_cast<int>(failure.code);
  }
}

}  // namespace meshrepair
