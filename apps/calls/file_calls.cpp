// SPDX-License-Identifier: MIT
#include "calls/file_calls.h"

#include <utility>

#include <spdlog/fmt/ranges.h>

#include <base/error.h>
#include <mesh/lost_attributes.h>
#include <mesh/soup_io.h>

#include "options/repair_options.h"
#include "program/program.h"
#include "report/findings.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"
#include "steps/step_options.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

std::optional<LengthUnit> unit_of(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  const std::optional<LengthUnit> unit = unit_named(*name);
  if (!unit) {
    throw UsageError("unit: " + *name +
                     " is none of micron, millimeter, centimeter, inch, foot, meter");
  }
  return unit;
}

void warn_of_lost(const GivenForFile& given, const Attributes& held, SoupFormat format,
                  const Findings& findings) {
  const std::vector<std::string> lost =
      lost_attributes(*given.soup, *given.attributes, held, format);
  if (lost.empty()) return;
  warn(findings.output_name(),
       {WarningCode::attributes_lost, fmt::format("{} cannot store these attributes: {}",
                                                  format_name(format), fmt::join(lost, ", "))});
}

}  // namespace

ReadOutcome read_call(const std::string& path, bool attributes, const Keywords& keywords,
                      const Runner& runner) {
  Session session("meshconvert");
  session.parse(keywords, {});
  if (path == "-") throw UsageError("-: is no file");
  Findings findings(path, "");
  ReadOutcome outcome;
  static_cast<Outcome&>(outcome) = runner(session, [&](Run& run) {
    return with_findings(run, findings, [&] {
      ReadOptions reading = read_options(run);
      reading.attributes = attributes;
      outcome.input = read_any_stage({}, reading, run, findings);
      return ExitCode::done;
    });
  });
  outcome.unit = findings.unit;
  return outcome;
}

Outcome write_call(const std::string& path, const GivenForFile& given, const Keywords& keywords,
                   const Runner& runner) {
  Session session("meshconvert");
  StepOptions options;
  add_format_option(session.options(), options.format);
  session.parse(keywords, {});
  if (path == "-") throw UsageError("-: is no file");
  options.output = path;
  options.sources = given.sources.has_value();
  WriteOptions format = mesh_format(options);
  format.extras.unit = unit_of(given.unit);
  Attributes held;
  if (given.attributes != nullptr) held = held_by(*format.format, *given.attributes);
  if (!held.empty()) format.extras.attributes = &held;
  if (given.sources) {
    if (given.sources->size() != given.soup->triangles.size()) {
      throw UsageError("sources: are not one for each face");
    }
    format.extras.sources = *given.sources;
  }
  return runner(session, [&](Run& run) {
    Findings findings("", path);
    return with_findings(run, findings, [&] {
      run.report.set_input(nullptr);
      if (given.attributes != nullptr) warn_of_lost(given, held, *format.format, findings);
      write_soup_stage(*given.soup, format, run, findings);
      return ExitCode::done;
    });
  });
}

}  // namespace meshrepair
