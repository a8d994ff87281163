// SPDX-License-Identifier: MIT
#include "steps/mesh_steps.h"

#include <filesystem>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <base/stage_meter.h>

#include "report/attribute_report.h"
#include "steps/guarantees.h"
#include "summary/warnings.h"
#include "terminal/warning_log.h"

namespace meshrepair {

ReadOptions read_options(Run& run) {
  ReadOptions options;
  if (run.options.max_triangles > 0) options.max_triangles = run.options.max_triangles;
  options.progress = &run.progress;
  return options;
}

WriteOptions mesh_format(const StepOptions& options) {
  const std::string& output = options.output;
  WriteOptions format;
  format.format = options.format ? options.format : format_of_extension(output);
  if (!format.format) {
    throw UsageError(output == "-" ? "standard output has no name that tells a format: use --format"
                                   : output + ": no mesh format has this extension (" +
                                         std::string(known_extensions()) +
                                         "; .gz or .zst behind it packs): use --format");
  }
  if (options.sources && !holds_sources(*format.format)) {
    throw UsageError("--sources: " + std::string(format_name(*format.format)) +
                     " cannot hold them, only PLY can");
  }
  check_format(*format.format, options.assets);
  format.staging = options.staging;
  if (!options.assets.root.empty())
    format.names_from = std::filesystem::path(options.input).parent_path();
  return format;
}

RepairOptions certified_for(SoupFormat format, RepairOptions options) {
  if (is_single(format)) options.certify.precision = Precision::float32;
  options.certify.welded = welds_points(format);
  return options;
}

ReadResult read_mesh_stage(const ReadOptions& options, Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("read");
  ReadResult result = read_soup(findings.input, options);
  keep_read_report(result.report, findings);
  return result;
}

namespace {

// What only a package could hold again.
bool is_written_as_package(const std::string& output) {
  return output == "-" || format_of_extension(output) == SoupFormat::threemf;
}

}  // namespace

void keep_read_report(ReadReport report, Findings& findings) {
  if (!is_written_as_package(findings.output)) {
    std::erase_if(report.warnings, [](const Warning& warning) {
      return warning.code == WarningCode::package_parts_lost;
    });
  }
  findings.unit = report.unit;
  findings.mesh_read = std::move(report);
  warn(findings.input_name(), findings.mesh_read->warnings);
}

Tree read_tree_stage(Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("read");
  Tree tree = read_tree(findings.input, read_options(run));
  findings.tree_read = facts_of(tree);
  return tree;
}

void warn_of_lost(const TriangleSoup& soup, const Attributes& all, const Attributes& held,
                  SoupFormat format, const Findings& findings) {
  const std::string lost = lost_words(soup, all, held, format);
  if (lost.empty()) return;
  warn(findings.output_name(), {WarningCode::attributes_lost,
                                fmt::format("{} cannot store these attributes of {}: {}",
                                            format_name(format), findings.input_name(), lost)});
}

void measure_distance_stage(const TriangleSoup& input, const Surface& surface, Precision precision,
                            Run& run, Findings& findings) {
  if (!run.options.wants_report() && !findings.wants_fidelity) return;
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("distance");
  findings.fidelity = measure_fidelity(input, surface, {precision, &run.progress});
}

Attributes transfer_attributes_stage(const TriangleSoup& input, const Attributes& attributes,
                                     const Surface& surface, Run& run, Findings& findings) {
  if (attributes.is_bare()) return attributes;
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("attributes");
  const bool has_walls = findings.has_walls || findings.repair.thicken.triangles > 0;
  return transfer_attributes(input, attributes, surface, has_walls, findings.repair.fewer.corners);
}

// Of a mesh without a name: nobody knows what those beside it are to be called.
void write_with_files(const TriangleSoup& soup, WriteOptions format, Run& run, Findings& findings) {
  keep_origin(findings, format);
  const Attributes* const attributes = format.extras.attributes;
  if (findings.output == "-" && attributes != nullptr &&
      has_files_beside(*format.format, *attributes)) {
    warn(findings.output_name(),
         {WarningCode::attributes_lost,
          fmt::format("{} has its materials and pictures in files beside it, and OUT has no name",
                      format_name(*format.format))});
  }
  findings.staging = format.staging.string();
  write_soup(soup, findings.output, format);
  run.report.set_output({{"path", findings.output}, {"format", format_name(*format.format)}});
}

std::string advice_to_thicken(const RepairReport& repair) {
  if (repair.thicken.fitting == 0) return {};
  return fmt::format("; --thicken {:g} makes walls of them", repair.thicken.fitting);
}

void write_mesh_stage(const Surface& surface, const Attributes& attributes, WriteOptions format,
                      const StepOptions& options, Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("write");
  look_at_file(surface, *format.format, findings);
  findings.missing_guarantees = missing_guarantees(findings, *format.format);
  warn_of_findings(findings);
  judge_requirements(options.required, findings);
  findings.withheld =
      options.strict && !(findings.missing_guarantees.empty() && findings.not_met.empty());
  if (findings.withheld) return;
  if (!options.sources) {
    format.extras.sources = {};
  } else if (format.extras.sources.empty()) {
    format.extras.sources = surface.source;
  }
  if (!attributes.empty()) format.extras.attributes = &attributes;
  format.progress = &run.progress;
  write_with_files(surface.mesh, format, run, findings);
}

void write_soup_stage(const TriangleSoup& soup, WriteOptions format, Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("write");
  format.progress = &run.progress;
  write_with_files(soup, format, run, findings);
  findings.soup_written = true;
  findings.soup_triangles = soup.triangles.size();
}

void write_tree_stage(const Tree& tree, Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("write");
  write_tree(tree, findings.output, &run.progress);
  findings.tree_written = facts_of(tree);
  run.report.set_output({{"path", findings.output}, {"format", "BSP tree"}});
}

}  // namespace meshrepair
