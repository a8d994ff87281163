// SPDX-License-Identifier: MIT
// meshdist A B...: how far meshes are from the first of them.
#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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
  std::vector<std::string> others;
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

// What is compared with A.
struct Other {
  Read read;
  MeshDistance distance;
};

Read read(const std::string& path, Run& run, Json& section, std::string& lines) {
  Findings findings(path, "");
  TriangleSoup soup = read_mesh_stage(read_options(run), run, findings).soup;
  section = read_section(*findings.mesh_read);
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

void write_page_stage(const Options& options, const Read& first, const std::vector<Other>& others,
                      Run& run) {
  if (!options.html.wanted()) return;
  DistancePage page{{first.name, first.soup}, {}, first.up, first.unit, sections_of(run)};
  for (const auto& [b, distance] : others) {
    page.others.push_back({{b.name, b.soup}, distance});
    if (b.up != View::Up::y) page.up = View::Up::z;
    if (!page.unit) page.unit = b.unit;
  }
  write_distance_page_stage(options.html, std::move(page), run);
}

void check_all_files(const Options& options, Run& run) {
  std::vector<std::string> files = {options.first};
  files.insert(files.end(), options.others.begin(), options.others.end());
  if (std::count(files.begin(), files.end(), "-") > 1) {
    throw UsageError("only one of the meshes can be standard input");
  }
  for (const std::string& file : files) check_files(file, "", run);
  check_html(options.html, files, run);
  check_inputs(files);
}

Other compare(const Options& options, const Read& first, const std::string& file, Run& run,
              Json& section, std::string& lines) {
  Other other;
  Json read_b;
  other.read = read(file, run, read_b, lines);
  bring_to_same_unit(first, other.read, lines);
  bring_to_same_origin(first, other.read);
  other.distance = mesh_distance(first.soup, other.read.soup, options.distance);
  lines += distance_table(other.distance);
  section = {{"read_b", std::move(read_b)},
             {"distance", distance_section(other.distance, options.distance)}};
  return other;
}

// Of one comparison its sections, else a list.
void report_comparisons(const Options& options, std::vector<Json> comparisons, Run& run) {
  if (comparisons.size() == 1) {
    for (const auto& [key, section] : comparisons[0].items()) run.report.set_section(key, section);
    return;
  }
  Json list = Json::array();
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    comparisons[i]["b"] = options.others[i];
    list.push_back(std::move(comparisons[i]));
  }
  run.report.set_section("comparisons", std::move(list));
}

ExitCode measure(Options& options, Run& run) {
  Json b = options.others.front();
  if (options.others.size() > 1) b = options.others;
  run.report.set_input({{"a", options.first}, {"b", std::move(b)}});
  check_all_files(options, run);
  options.distance.progress = &run.progress;
  std::string lines;
  Json section;
  const Read first = read(options.first, run, section, lines);
  run.report.set_section("read", std::move(section));
  std::vector<Other> others;
  std::vector<Json> comparisons;
  for (const std::string& file : options.others) {
    if (!others.empty()) lines += "\n";
    Other other = compare(options, first, file, run, comparisons.emplace_back(), lines);
    if (!options.html.wanted()) other.read.soup = {};
    others.push_back(std::move(other));
  }
  report_comparisons(options, std::move(comparisons), run);
  write_page_stage(options, first, others, run);
  run.progress.finish();
  if (run.options.report != "-" && !run.options.quiet) std::cout << lines;
  return ExitCode::done;
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  Options options;
  Program program("meshdist",
                  "Measures the distance of meshes from the first one, in both directions.",
                  "  meshdist original.stl repaired.stl\n"
                  "  meshdist original.stl half.stl tenth.stl --html levels.html\n"
                  "  meshdist original.stl repaired.stl --bound --json | jq .distance.bound\n");
  CommandLine& app = program.command_line();
  app.add_option("A", options.first,
                 "Mesh: STL, OBJ, OFF, PLY, glTF or 3MF, optionally compressed (.gz, .zst,\n.zip);"
                 " relative distances refer to its bounding box diagonal; - is standard\ninput")
      ->check(names_file(mesh_extensions()))
      ->required();
  app.add_option("B", options.others, "Meshes, each compared with A; - is standard input")
      ->check(names_file(mesh_extensions()))
      ->required()
      ->repeated();
  add_distance_options(app, options.distance);
  add_html_options(app, options.html, "A and one B at a time, coloured\nby their distance");
  app.add_flag("--json", options.json, "Print the report instead of the table: --report -")
      ->group("Output");
  return program.run(argc, argv, [&](Run& run) {
    if (options.json) program.report_to_standard_output();
    return measure(options, run);
  });
}
