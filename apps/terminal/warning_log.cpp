// SPDX-License-Identifier: MIT
#include "terminal/warning_log.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <spdlog/fmt/fmt.h>
#include <spdlog/logger.h>

#include "terminal/logging.h"

namespace meshrepair {
namespace {

constexpr std::size_t kMostWarnings = 10;

thread_local WarningLog* log_of_thread = nullptr;

void log_first(const std::vector<std::string>& texts) {
  const std::size_t shown = std::min(texts.size(), kMostWarnings);
  for (std::size_t i = 0; i < shown; ++i) logger().warn("{}", texts[i]);
  if (texts.size() > shown) {
    logger().warn("{} more warnings, all in the report", texts.size() - shown);
  }
}

}  // namespace

WarningLog::WarningLog() { log_of_thread = this; }

WarningLog::~WarningLog() { log_of_thread = nullptr; }

std::string text_of(const ToldWarning& told) {
  return fmt::format("{}{}{} [{}]", told.about, told.about.empty() ? "" : ": ", told.warning.text,
                     kind_of(told.warning.code).code);
}

void warn(const std::string& about, const std::vector<Warning>& warnings) {
  std::vector<std::string> shown;
  for (const Warning& warning : warnings) {
    ToldWarning told{about, warning};
    const bool is_held = log_of_thread != nullptr && kind_of(warning.code).changes_object;
    (is_held ? log_of_thread->held_ : shown).push_back(text_of(told));
    if (log_of_thread != nullptr) log_of_thread->told_.push_back(std::move(told));
  }
  log_first(shown);
}

void warn(const std::string& about, Warning warning) {
  warn(about, std::vector<Warning>{std::move(warning)});
}

std::vector<ToldWarning> told_warnings() {
  return log_of_thread == nullptr ? std::vector<ToldWarning>() : log_of_thread->told();
}

void show_held_warnings() {
  if (log_of_thread != nullptr) log_first(std::exchange(log_of_thread->held_, {}));
}

}  // namespace meshrepair
