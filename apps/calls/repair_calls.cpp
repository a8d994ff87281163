// SPDX-License-Identifier: MIT
#include "calls/repair_calls.h"

#include <functional>
#include <string_view>
#include <utility>

#include <base/error.h>

#include "report/words.h"
#include "steps/bodies_steps.h"
#include "steps/boolean_steps.h"
#include "steps/run_steps.h"
#include "summary/warnings.h"

namespace meshrepair {
namespace {

// Options that name files, or say what is in files.
const std::vector<std::string_view> kOfFiles = {
    "scene",   "sources",        "staging",      "root",           "units",
    "explain", "picture",        "picture-size", "picture-view",   "picture-colours",
    "show",    "show-as",        "html",         "html-triangles", "points",
    "origin",  "restore-origin", "negative",     "beam-sides",     "by"};

// What the caller gives in single precision comes back so, certified so, unless it is asked
// otherwise.
bool fit_precision(bool from_float32, const Keywords& keywords, RepairOptions& repair) {
  for (const Keyword& keyword : keywords) {
    if (keyword.first == "precision") return repair.certify.precision == Precision::float32;
  }
  if (from_float32) repair.certify.precision = Precision::float32;
  return from_float32;
}

using InMemory = std::function<RepairedMesh(Run&, Findings&)>;

// Runs `work`, and says of its result what it lacks.
RepairOutcome run_in_memory(const Session& session, const Runner& runner, const std::string& name,
                            StepOptions& steps, const InMemory& work) {
  RepairOutcome outcome;
  static_cast<Outcome&>(outcome) = runner(session, [&](Run& run) {
    Findings findings(name, "the result");
    findings.purpose = steps.purpose;
    findings.wants_fidelity = asks_for_distance(steps.required);
    steps.repair.progress = &run.progress;
    (void)with_findings(run, findings, [&] {
      run.report.set_input(nullptr);
      outcome.mesh = work(run, findings);
      return ExitCode::done;
    });
    warn_of_findings(findings);
    if (findings.missing_guarantees.empty() && findings.not_met.empty()) return ExitCode::done;
    run.report.set_error(findings.missing_guarantees.empty()
                             ? "the result: " + joined_with("; ", findings.not_met)
                             : "the result is " + findings.missing_guarantees);
    return ExitCode::not_certified;
  });
  return outcome;
}

}  // namespace

RepairOutcome repair_call(AnySoup input, bool from_float32, bool distance, const Keywords& keywords,
                          const Runner& runner) {
  Session session("meshrepair");
  RepairCommand command;
  add_repair_command(session.options(), command);
  session.parse(keywords, kOfFiles);
  if (distance) session.common().report = "-";
  const bool as_float32 = fit_precision(from_float32, keywords, command.steps.repair);
  RepairOutcome outcome = run_in_memory(session, runner, input.cloud ? "the points" : "the mesh",
                                        command.steps, [&](Run& run, Findings& findings) {
                                          return repair_in_memory(input, command, run, findings);
                                        });
  outcome.as_float32 = as_float32;
  return outcome;
}

Outcome repair_file_call(const std::string& input, const std::string& output, bool distance,
                         const Keywords& keywords, const Runner& runner) {
  Session session("meshrepair");
  RepairCommand command;
  add_repair_command(session.options(), command);
  session.parse(keywords, {});
  if (input == "-" || output == "-") throw UsageError("-: is no file");
  if (distance) session.common().report = "-";
  command.steps.input = input;
  command.steps.output = output;
  return runner(session, [&](Run& run) {
    return run_steps(command.steps, run, [&](const StepOptions&, Run&, Findings& findings) {
      repair_file(command, run, findings);
    });
  });
}

RepairOutcome boolean_call(std::vector<AnySoup> operands, bool from_float32,
                           const Keywords& keywords, const Runner& runner) {
  Session session("bspbool");
  BooleanCommand command;
  add_boolean_command(session.options(), command);
  session.parse(keywords, kOfFiles);
  for (std::size_t n = 0; n < operands.size(); ++n) command.inputs.push_back(operand_name(n));
  const bool as_float32 = fit_precision(from_float32, keywords, command.step.repair);
  RepairOutcome outcome =
      run_in_memory(session, runner, "", command.step, [&](Run& run, Findings& findings) {
        findings.input = "the operands";  // from now on: errors name the operand by themselves
        return combine_in_memory(std::move(operands), command, run, findings);
      });
  outcome.as_float32 = as_float32;
  return outcome;
}

BodiesOutcome bodies_call(std::vector<TriangleSoup> meshes, const Keywords& keywords,
                          const Runner& runner) {
  Session session("meshbodies");
  BodiesCommand command;
  add_bodies_command(session.options(), command);
  session.parse(keywords, kOfFiles);
  BodiesOutcome outcome;
  static_cast<Outcome&>(outcome) = runner(session, [&](Run& run) {
    Bodies bodies;
    Json facts = Json::array();
    for (std::size_t n = 0; n < meshes.size(); ++n) {
      Findings findings(operand_name(n), "");
      findings.mesh_read.emplace();
      bodies.add({std::to_string(n), std::move(meshes[n])}, command, run, findings, facts);
    }
    run.report.set_section("operands", std::move(facts));
    Findings findings("the bodies", "the result");
    return with_findings(run, findings, [&] {
      run.report.set_input(nullptr);
      BodiesFacts told;
      outcome.bodies = divide_bodies(bodies, command, told.report, run, findings);
      tell_of_bodies(bodies, outcome.bodies, command, told, run);
      const std::string missing = missing_guarantees(told.report);
      if (missing.empty()) return ExitCode::done;
      run.report.set_error("the result is " + missing);
      return ExitCode::not_certified;
    });
  });
  return outcome;
}

std::string operand_name(std::size_t n) { return "operand " + std::to_string(n); }

}  // namespace meshrepair
