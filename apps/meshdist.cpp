// SPDX-License-Identifier: MIT
// meshdist A B: how far two meshes are apart.
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <check/mesh_distance.h>
#include <mesh/far_coordinates.h>

#include "options/file_kinds.h"
#include "page/distance_page.h"
#include "pictures/picture_steps.h"
#include "program/command_files.h"
#include "report/distance_report.h"
#include "report/report_sections.h"
#include "report/words.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"
#include "summary/summary.h"

namespace meshrepair {
namespace {

struct Options {
  std::string first;
  std::string second;
  bool json = false;
  DistanceOptions distance;
  HtmlRequest html;
};

struct Read {
  TriangleSoup soup;
  std::optional<LengthUnit> unit;
  std::optional<Vec3d> offset;
  std::string name;  // for people
  View::Up up = View::Up::z;
};

Read read(const std::string& path, const std::string& key, Run& run, std::string& lines) {
  Findings findings(path, "");
  TriangleSoup soup = read_mesh_stage(read_options(run), run, findings).soup;
  run.report.set_section(key, read_section(*findings.mesh_read));
  lines +=
      fmt::format("{}: {}, {}\n", findings.input_name(),
                  format_words(format_name(findings.mesh_read->format), findings.mesh_read->packed),
                  number_of(soup.triangles.size(), "triangle"));
  return {std::move(soup), findings.unit, findings.mesh_read->offset,
          page_name(path, findings.input_name()), up_of(findings)};
}

// Of two that say their units, the second is brought to that of the first.
void bring_to_same_unit(const Read& first, Read& second, std::string& lines) {
  if (!first.unit || !second.unit || first.unit == second.unit) return;
  bring_to_unit(*second.unit, *first.unit, second.soup);
  lines += fmt::format("B is in {}, and is brought to {}\n", units_text(second.unit),
                       units_text(first.unit));
}

// Files may name offsets that were subtracted from their coordinates.
void bring_to_same_origin(const Read& first, Read& second) {
  const Vec3d none = Vec3d::Zero();
  move_points(second.soup.points, second.offset.value_or(none) - first.offset.value_or(none));
}

// The sections of the report, which stays as it is.
Json sections_of(Run& run) {
  Json sections = run.report.take_sections();
  for (const auto& [key, section] : sections.items()) run.report.set_section(key, section);
  return sections;
}

void write_page_stage(const Options& options, const Read& first, const Read& second,
                      const MeshDistance& distance, Run& run) {
  if (!options.html.wanted()) return;
  const bool y_is_up = first.up == View::Up::y && second.up == View::Up::y;
  write_distance_page_stage(options.html,
                            {{first.name, first.soup},
                             {second.name, second.soup},
                             distance,
                             y_is_up ? View::Up::y : View::Up::z,
                             first.unit ? first.unit : second.unit,
                             sections_of(run)},
                            run);
}

ExitCode measure(Options& options, Run& run) {
  if (options.first == "-" && options.second == "-") {
    throw UsageError("only one of the meshes can be standard input");
  }
  check_files(options.first, "", run);
  check_files(options.second, "", run);
  check_html(options.html, {options.first, options.second}, run);
  run.report.set_input({{"a", options.first}, {"b", options.second}});
  options.distance.progress = &run.progress;
  std::string lines;
  const Read first = read(options.first, "read", run, lines);
  Read second = read(options.second, "read_b", run, lines);
  bring_to_same_unit(first, second, lines);
  bring_to_same_origin(first, second);
  const MeshDistance distance = mesh_distance(first.soup, second.soup, options.distance);
  run.report.set_section("distance", distance_section(distance, options.distance));
  write_page_stage(options, first, second, distance, run);
  run.progress.finish();
  if (run.options.report != "-" && !run.options.quiet) {
    std::cout << lines << distance_table(distance);
  }
  return ExitCode::done;
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  Options options;
  Program program("meshdist", "Measures the distance between two meshes in both directions.",
                  "  meshdist original.stl repaired.stl\n"
                  "  meshdist original.stl repaired.stl --bound --json | jq .distance.bound\n");
  CommandLine& app = program.command_line();
  app.add_option("A", options.first,
                 "Mesh: STL, OBJ, OFF, PLY, glTF or 3MF, optionally compressed (.gz, .zst,\n.zip);"
                 " relative distances refer to its bounding box diagonal; - is standard\ninput")
      ->check(names_file(mesh_extensions()))
      ->required();
  app.add_option("B", options.second, "Mesh; - is standard input")
      ->check(names_file(mesh_extensions()))
      ->required();
  add_distance_options(app, options.distance);
  add_html_options(app, options.html, "A and B, coloured by their distance");
  app.add_flag("--json", options.json, "Print the report instead of the table: --report -")
      ->group("Output");
  return program.run(argc, argv, [&](Run& run) {
    if (options.json) program.report_to_standard_output();
    return measure(options, run);
  });
}
