// SPDX-License-Identifier: MIT
#include "steps/boolean_steps.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include <spdlog/logger.h>

#include <mesh/append_soup.h>
#include <mesh/skins.h>
#include <mesh/topology.h>

#include "options/choice_option.h"
#include "options/repair_options.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/report_sections.h"
#include "report/words.h"
#include "steps/guarantees.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"
#include "summary/warnings.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

std::array<Choice<SetOperation>, 4> named_operations() {
  constexpr std::array kAll = {SetOperation::unite, SetOperation::intersect, SetOperation::subtract,
                               SetOperation::exclude};
  std::array<Choice<SetOperation>, 4> named;
  for (std::size_t i = 0; i < kAll.size(); ++i) named[i] = {operation_name(kAll[i]), kAll[i]};
  return named;
}

void add_operation_options(CommandLine& app, BooleanCommand& command) {
  static const auto operations = named_operations();
  add_choice(
      app, "--op", operations, [&command](SetOperation value) { command.operation = value; },
      "Operation (required):\n"
      "  union         inside at least one solid\n"
      "  intersection  inside all solids\n"
      "  difference    inside the first and no other\n"
      "  xor           inside an odd number of solids")
      ->required();
  app.add_flag("--always", command.always,
               "Merge trees of all solids instead of cutting their triangles;\n"
               "the result is the same");
}

bool is_certified(const Operand& operand, const Findings& findings) {
  return operand.as_given || operand.solid.triangles.empty() || findings.repair.certify.passed();
}

// With the sections that a report of it alone would have.
Json facts_of_operand(const Operand& operand, const Findings& findings, const Json& sections) {
  Json facts = {{"path", findings.input},
                {"triangles", operand.solid.triangles.size()},
                {"volume", signed_volume(operand.solid)},
                {"as_given", operand.as_given},
                {"certified", is_certified(operand, findings)}};
  facts.update(sections);
  facts["stages"] = stages_section(findings.repair.stages);
  return facts;
}

Json merge_section(const BooleanReport& report, SetOperation operation) {
  Json merges = Json::array();
  for (const MergeReport& merge : report.merges) {
    merges.push_back({{"nodes", merge.nodes},
                      {"kept_nodes", merge.kept_nodes},
                      {"regions", merge.regions},
                      {"cut_regions", merge.cut_regions}});
  }
  return {{"operation", operation_name(operation)}, {"merges", merges}};
}

// `source`: of each triangle of the operands, in their order, which one it lies in, counted through
// the triangles of all meshes.
Operands operands_of(std::vector<AnySoup> meshes, const BooleanCommand& command,
                     std::vector<std::uint32_t>& source, Run& run) {
  std::size_t given = 0;
  Json facts = Json::array();
  Operands operands;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Findings findings(command.inputs[i], "");
    findings.mesh_read.emplace();
    Operand operand;
    const std::size_t triangles = meshes[i].soup.triangles.size();
    (void)with_findings(run, findings, [&] {
      operand = make_operand(std::move(meshes[i].soup), std::move(meshes[i].attributes),
                             operand_options(command, run), run, findings);
      return ExitCode::done;
    });
    end_operand(operand, findings, run, facts);
    operand.attributes =
        chosen_for(command.step.format, command.step.assets, std::move(operand.attributes));
    for (const std::uint32_t t : operand.source) {
      source.push_back(t == Surface::kNoSource ? t : static_cast<std::uint32_t>(given + t));
    }
    given += triangles;
    operands.add(std::move(operand));
  }
  run.report.set_section("operands", std::move(facts));
  return operands;
}

}  // namespace

void add_boolean_command(CommandLine& app, BooleanCommand& command) {
  RepairOptions& repair = command.step.repair;
  add_inside_options(app, repair.inside);
  add_sew_option(app, repair.sew);
  add_join_gaps_option(app, repair.join_gaps);
  add_holes_option(app, repair.holes);
  add_max_hole_option(app, repair.holes);
  add_touching_option(app, repair.extract.touching);
  add_operation_options(app, command);
  add_predicates_options(app, repair);
  add_format_option(app, command.step.format);
  add_drop_option(app, command.step.assets);
  add_units_option(app, command.step.assets);
  add_certify_options(app, repair.certify, command.step.strict);
}

void JoinedMeshes::add(const TriangleSoup& other, Attributes carried) {
  append_attributes(attributes, soup.triangles.size(), std::move(carried), other.triangles.size());
  append_soup(soup, other);
}

RepairOptions operand_options(const BooleanCommand& command, Run& run) {
  RepairOptions options = command.step.repair;
  options.certify.precision = Precision::float64;
  options.join_gaps = {};  // of all operands together
  options.progress = &run.progress;
  return options;
}

Operand make_operand(TriangleSoup soup, Attributes attributes, RepairOptions options, Run& run,
                     Findings& findings) {
  if (soup.triangles.empty()) return {{}, {}, true, {}};
  keep_attributes(soup, attributes, options);
  {
    StageMeter meter(findings.repair.stages, &run.progress);
    meter.begin("validate");
    if (auto kept = keep_valid(soup, options)) {
      attributes = attributes.empty() ? Attributes() : transfer_attributes(soup, attributes, *kept);
      return {std::move(kept->mesh), std::move(attributes), true, std::move(kept->source)};
    }
  }
  options.all_cells = false;
  Surface solid = repair(soup, options, findings.repair);
  attributes = transfer_attributes_stage(soup, attributes, solid, run, findings);
  return {std::move(solid.mesh), std::move(attributes), false, std::move(solid.source)};
}

void end_operand(const Operand& operand, Findings& findings, Run& run, Json& facts) {
  warn_of_findings(findings);
  if (!is_certified(operand, findings)) {
    warn(findings.input_name(),
         {WarningCode::operand_uncertified, "could not be certified as a solid"});
  } else if (findings.mesh_read && !operand.as_given) {
    warn(findings.input_name(),
         {WarningCode::operand_repaired, "not a valid solid by these rules; it is repaired first"});
  }
  facts.push_back(facts_of_operand(operand, findings, run.report.take_sections()));
}

void Operands::add(Operand operand) {
  // Joints and targets of several files are not those of one mesh.
  std::erase_if(operand.attributes.corners, [](const CornerAttribute& one) {
    return one.kind == CornerAttribute::Kind::skin || morph_target_of(one);
  });
  std::size_t triangles = 0;
  for (const TriangleSoup& solid : solids) triangles += solid.triangles.size();
  append_attributes(joined.attributes, triangles, std::move(operand.attributes),
                    operand.solid.triangles.size());
  solids.push_back(std::move(operand.solid));
}

void Operands::join() {
  if (joined.attributes.is_bare()) return;
  for (const TriangleSoup& solid : solids) append_soup(joined.soup, solid);
}

BooleanOptions boolean_options(const BooleanCommand& command, Run& run) {
  BooleanOptions options;
  options.by_trees = command.always;
  options.repair = command.step.repair;
  options.repair.progress = &run.progress;
  return options;
}

void warn_of_common_grid(const std::vector<std::string>& names,
                         const std::vector<OperandReport>& operands) {
  for (std::size_t i = 0; i < operands.size(); ++i) {
    const CleanReport& clean = operands[i].clean;
    if (clean.dropped_below_grid == 0) continue;
    warn(names[i], {WarningCode::below_grid,
                    fmt::format("{} left out: narrower than the step of the common grid, {:.3g}",
                                number_of(clean.dropped_below_grid, "triangle"), clean.grid_unit),
                    {{"triangles", clean.dropped_below_grid}, {"step", clean.grid_unit}}});
  }
}

void tell_of_boolean(const BooleanCommand& command, const BooleanReport& report, Run& run) {
  run.report.set_section("boolean", merge_section(report, command.operation));
  warn_of_common_grid(command.inputs, report.operands);
}

Surface combine(const Operands& operands, const BooleanCommand& command,
                const BooleanOptions& options, Run& run, Findings& findings) {
  BooleanReport report;
  Surface surface = boolean(operands.solids, command.operation, options, report);
  tell_of_boolean(command, report, run);
  findings.repair = report.result;
  return surface;
}

RepairedMesh combine_in_memory(std::vector<AnySoup> meshes, const BooleanCommand& command, Run& run,
                               Findings& findings) {
  // OBJ keeps indices and all digits, as memory does.
  const SoupFormat format = command.step.format.value_or(SoupFormat::obj);
  BooleanOptions options = boolean_options(command, run);
  options.repair = certified_for(format, options.repair);
  std::vector<std::uint32_t> source;
  Operands operands = operands_of(std::move(meshes), command, source, run);
  operands.join();
  keep_attributes(operands.joined.soup, operands.joined.attributes, options.repair);
  RepairedMesh result;
  result.surface = combine(operands, command, options, run, findings);
  if (result.surface.mesh.triangles.empty()) return result;
  result.attributes = transfer_attributes_stage(operands.joined.soup, operands.joined.attributes,
                                                result.surface, run, findings);
  for (std::uint32_t& t : result.surface.source) {
    if (t != Surface::kNoSource) t = source[t];
  }
  look_at_file(result.surface, format, findings);
  findings.missing_guarantees = missing_guarantees(findings, format);
  return result;
}

}  // namespace meshrepair
