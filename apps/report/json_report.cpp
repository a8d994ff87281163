// SPDX-License-Identifier: MIT
#include "report/json_report.h"

#include <algorithm>
#include <utility>

#include <base/assert.h>
#include <base/internal/system.h>

namespace meshrepair {
namespace {

constexpr const char* kTailKeys[] = {"stages",    "seconds", "peak_memory_bytes",
                                     "exit_code", "error",   "warnings"};

// A program that measures the peak of each stage sets the system's count back in between.
std::uint64_t peak_memory_bytes(const Json& stages) {
  std::uint64_t peak = internal::peak_memory();
  for (const Json& stage : stages.values()) {
    const Json* const bytes = stage.find("peak_bytes");
    if (bytes != nullptr) peak = std::max(peak, bytes->as_count().value_or(0));
  }
  return peak;
}

Json stages_of(const ProgressBar& progress) {
  Json stages = Json::array();
  for (const StageTime& time : progress.stages()) {
    stages.push_back({{"name", time.name}, {"seconds", time.seconds}});
  }
  return stages;
}

}  // namespace

std::string program_version() { return MESHREPAIR_VERSION; }

Json warnings_section(const std::vector<ToldWarning>& warnings) {
  Json section = Json::array();
  for (const auto& [about, warning] : warnings) {
    const WarningKind& kind = kind_of(warning.code);
    Json numbers = Json::object();
    for (const WarningNumber& number : warning.numbers) {
      numbers[std::string(number.name)] = number.value;
    }
    section.push_back({{"code", kind.code},
                       {"about", about.empty() ? Json() : Json(about)},
                       {"text", warning.text},
                       {"changes_object", kind.changes_object},
                       {"numbers", std::move(numbers)}});
  }
  return section;
}

JsonReport::JsonReport(const std::string& program, const std::vector<std::string>& command)
    : head_(Json::object()), sections_(Json::object()), warnings_(Json::array()) {
  head_["program"] = program;
  head_["version"] = program_version();
  head_["report_version"] = kReportVersion;
  head_["command"] = command;
  head_["input"] = nullptr;
  head_["output"] = nullptr;
}

void JsonReport::set_input(Json input) { head_["input"] = std::move(input); }

void JsonReport::set_output(Json output) { head_["output"] = std::move(output); }

void JsonReport::set_warnings(const std::vector<ToldWarning>& warnings) {
  warnings_ = warnings_section(warnings);
}

void JsonReport::set_stages(Json stages) { stages_ = std::move(stages); }

void JsonReport::set_section(const std::string& key, Json section) {
  MESHREPAIR_ASSERT(!head_.contains(key));
  for (const char* reserved : kTailKeys) MESHREPAIR_ASSERT(key != reserved);
  sections_[key] = std::move(section);
}

Json JsonReport::take_sections() { return std::exchange(sections_, Json::object()); }

Json JsonReport::json(ExitCode code, const std::optional<Failure>& failure,
                      const ProgressBar& progress) const {
  Json report = head_;
  report.update(sections_);
  report["warnings"] = warnings_;
  report["stages"] = stages_.is_null() ? stages_of(progress) : stages_;
  report["seconds"] = progress.seconds();
  report["peak_memory_bytes"] = peak_memory_bytes(report["stages"]);
  report["exit_code"] = static_cast<int>(code);
  report["error"] = failure ? Json(failure->message) : error_ ? Json(*error_) : Json();
  return report;
}

}  // namespace meshrepair
