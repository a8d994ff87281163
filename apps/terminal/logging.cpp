// SPDX-License-Identifier: MIT
#include "terminal/logging.h"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <base/internal/system.h>

namespace meshrepair {
namespace {

spdlog::level::level_enum level_of(Verbosity verbosity) {
  switch (verbosity) {
    case Verbosity::quiet:
      return spdlog::level::err;
    case Verbosity::normal:
      return spdlog::level::warn;
    case Verbosity::verbose:
      return spdlog::level::debug;
  }
  return spdlog::level::warn;
}

// Of the program, or of the calls of a process; not spdlog's own, which is the caller's there.
std::shared_ptr<spdlog::logger>& the_logger() {
  static auto& logger =
      *new std::shared_ptr<spdlog::logger>(std::make_shared<spdlog::logger>("meshrepair"));
  return logger;
}

bool environment_has(const char* variable) {
  const char* value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): before any thread
  return value != nullptr && *value != '\0';
}

}  // namespace

spdlog::logger& logger() { return *the_logger(); }

void set_logger(std::shared_ptr<spdlog::logger> logger) { the_logger() = std::move(logger); }

bool stderr_is_terminal() {
  const char* terminal = std::getenv("TERM");  // NOLINT(concurrency-mt-unsafe): never changed
  return internal::is_terminal(internal::kStandardError) &&
         (terminal == nullptr || std::string_view(terminal) != "dumb");
}

void set_up_logging(const std::string& program, Verbosity verbosity) {
  const bool colours = stderr_is_terminal() && !environment_has("NO_COLOR");
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(
      colours ? spdlog::color_mode::always : spdlog::color_mode::never);
  auto made = std::make_shared<spdlog::logger>(program, std::move(sink));
  made->set_level(level_of(verbosity));
  made->flush_on(spdlog::level::trace);
  // On a terminal each line first clears what the progress bar has drawn there.
  const std::string clear_line = stderr_is_terminal() ? "\r\x1b[K" : "";
  // The same line end on all systems, as in all other lines.
  made->set_formatter(std::make_unique<spdlog::pattern_formatter>(
      clear_line + "%n: %^%l%$: %v", spdlog::pattern_time_type::local, "\n"));
  set_logger(std::move(made));
}

void print_summary(std::string_view lines) {
  if (!logger().should_log(spdlog::level::warn)) return;
  std::fwrite(lines.data(), 1, lines.size(), stderr);
  std::fflush(stderr);  // before what the logger writes, which knows no buffer
}

}  // namespace meshrepair
