// SPDX-License-Identifier: MIT
#include "steps/point_steps.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <repair/repair_on_base.h>

#include "options/numbers.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/words.h"
#include "steps/mesh_steps.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

constexpr const char* kHowToSmooth = ": --project 3 --neighbours 30 smooths them";

std::string why_noisy(const PointSoupReport& soup) {
  if (soup.agreement() >= kNoisyAgreement) return {};
  return "the points are noisy, all three corners want only " + percent(soup.agreement()) +
         " of the triangles";
}

// What is there, but is no surface for the triangulation.
constexpr double kManyUnused = 0.1;

// Of a result that is a solid, but maybe not that of the points.
void warn_of_points(const Findings& findings) {
  const PointSoupReport& soup = *findings.point_soup;
  const std::string noisy = why_noisy(soup);
  if (!noisy.empty()) {
    warn(findings.input_name(),
         {WarningCode::points_noisy, noisy + kHowToSmooth, {{"agreement", soup.agreement()}}});
  }
  if (findings.repair.thicken.triangles > 0) return;  // they are within walls
  const std::size_t unused = soup.points - std::min(soup.points, findings.points_in_result);
  if (static_cast<double>(unused) <= kManyUnused * static_cast<double>(soup.points)) return;
  warn(findings.input_name(), {WarningCode::points_unused,
                               fmt::format("{} of {} are not on the result: do they lie along "
                                           "lines, or inside, or is there more than one surface?",
                                           unused, number_of(soup.points, "point")),
                               {{"unused", unused}, {"points", soup.points}}});
}

// What has not been tried yet.
std::string advice(const Findings& findings) {
  const std::string noisy = why_noisy(*findings.point_soup);
  if (noisy.empty()) {
    const double wall = findings.repair.thicken.fitting;
    return "; --base closes a scan that is open below, " +
           (wall > 0 ? fmt::format("--thicken {:g} makes a wall of it, ", wall) : std::string()) +
           "and meshrepair on what pointmesh writes closes whatever it can";
  }
  if (findings.tries.size() <= 1) return "; " + noisy + kHowToSmooth;
  const PointTry& last = findings.tries.back();
  return fmt::format("; {}, also of those smoothed with --project {} --neighbours {}", noisy,
                     last.project, last.neighbours);
}

PointCloud keep(PointReadResult result, Findings& findings) {
  findings.points_read = std::move(result.report);
  warn(findings.input_name(), findings.points_read->warnings);
  return std::move(result.cloud);
}

}  // namespace

void add_point_options(CommandLine& app, PointSoupOptions& options) {
  app.add_option("--votes", options.votes,
                 "Keep a triangle if at least this many of its corners propose it: 1, 2 or 3")
      ->check(count_between(1, 3))
      ->type_name("N")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--reach", options.reach,
                 "Bridge gaps up to this radius, in multiples of the local point spacing")
      ->check(number_between(0.1, 1000))
      ->type_name("X")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--neighbours", options.neighbours,
                 "Number of neighbours that a tangent plane is fitted to")
      ->check(count_between(5, 1000))
      ->type_name("N")
      ->capture_default_str()
      ->group("Points");
  app.add_option(
         "--outliers", options.outlier,
         "Drop points whose spacing exceeds that of their neighbours by this factor; 0: none")
      ->check(number_between(0))
      ->type_name("X")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--project", options.project,
                 "Smooth noisy points: project each onto a surface fitted to its neighbours, this\n"
                 "many times")
      ->check(count_between(0, 100))
      ->type_name("N")
      ->capture_default_str()
      ->group("Points");
  app.add_flag_callback(
         "--no-normals", [&options] { options.use_normals = false; },
         "Ignore the normals of the points")
      ->group("Points");
}

PointCloud read_points_stage(Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("read");
  PointReadOptions options;
  options.progress = &run.progress;
  return keep(read_points(findings.input, options), findings);
}

PointSoup triangulate_stage(const PointCloud& cloud, PointSoupOptions options, Run& run,
                            Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("points");
  options.progress = &run.progress;
  options.most_triangles = run.options.max_triangles;
  return make_point_soup(cloud, options, findings.point_soup.emplace());
}

namespace {

void add_base_options(CommandLine& app, RepairPointsOptions& options) {
  ScanBaseOptions& base = options.scan_base;
  app.add_flag("--base", options.base,
               "Close an open scan or mesh, such as a terrain, with walls and a floor")
      ->group("Points");
  CommandOption* depth =
      app.add_option_function(
             "--base-depth",
             [&options, &base](const std::string& word) {
               options.base = true;
               std::tie(base.depth, base.is_share) =
                   length_in(word).value_or(std::pair(0.0, false));
             },
             "Depth of the floor below the lowest point, in units of IN, or as a percentage of\n"
             "the bounding box diagonal")
          ->check(why_no_length)
          ->type_name("X|X%")
          ->default_str("5%")
          ->group("Points");
  app.add_option_function(
         "--base-at",
         [&options, &base](const std::string& word) {
           options.base = true;
           base.floor = parse_number(word);
         },
         "Position of the floor on the up axis, in units of IN")
      ->check(number_between(std::numeric_limits<double>::lowest()))
      ->excludes(depth)
      ->type_name("X")
      ->group("Points");
  app.add_option_function(
         "--up", [&base](const std::string& axis) { base.axis = axis[0] - 'x'; },
         "Up axis: x, y or z")
      ->check(is_one_of({"x", "y", "z"}))
      ->type_name("NAME")
      ->default_str("z")
      ->group("Points");
}

}  // namespace

void add_point_repair_options(CommandLine& app, PointOptions& options) {
  app.add_flag("--points", options.as_points, "Ignore the faces of a mesh and use only its points")
      ->group("Points");
  add_base_options(app, options.repair);
  add_point_options(app, options.repair.soup);
  PointAdviceOptions& advice = options.repair.advice;
  app.add_flag_callback(
         "--no-advice",
         [&advice] {
           advice = {false, false, false};
         },
         "Do not retry with other --project, --neighbours and --base if the points enclose\n"
         "nothing")
      ->group("Points");
  // What is given by hand stays.
  app.option("--project").each([&advice](const std::string&) { advice.project = false; });
  app.option("--neighbours").each([&advice](const std::string&) { advice.neighbours = false; });
}

AnySoup read_any_stage(const PointOptions& options, const ReadOptions& reading, Run& run,
                       Findings& findings) {
  AnySoup input;
  if (options.as_points) {
    input.cloud = read_points_stage(run, findings);
    return input;
  }
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("read");
  MeshOrPoints found = read_mesh_or_points(findings.input, reading);
  if (!found.mesh) {
    input.cloud = keep(std::move(*found.points), findings);
    return input;
  }
  keep_read_report(std::move(found.mesh->report), findings);
  input.soup = std::move(found.mesh->soup);
  input.attributes = std::move(found.mesh->attributes);
  input.scene = std::move(found.mesh->scene);
  input.placed = std::move(found.mesh->placed);
  return input;
}

namespace {

// Also of a repair that ended with an exception.
void keep_point_report(const RepairPointsReport& report, Findings& findings) {
  findings.point_soup = report.soup;
  findings.scan_base = report.scan_base;
  findings.tries = report.tries;
  findings.dropped_solids = report.dropped_solids;
  findings.points_in_result = report.points_in_result;
  findings.joined_columns = report.joined_columns;
}

}  // namespace

Surface repair_any(AnySoup& input, const PointOptions& points, const RepairOptions& options,
                   Run& run, Findings& findings) {
  if (!input.cloud) {
    if (!points.repair.base) return repair(input.soup, options, findings.repair);
    return repair_on_base(input.soup, points.repair.scan_base, options,
                          findings.scan_base.emplace(), findings.repair);
  }
  RepairPointsOptions point_options = points.repair;
  point_options.repair = options;
  point_options.soup.most_triangles = run.options.max_triangles;
  RepairPointsReport report;
  try {
    PointSolid solid = repair_points(*input.cloud, point_options, report, findings.repair);
    keep_point_report(report, findings);
    warn_of_points(findings);
    input.soup = std::move(solid.soup);
    return std::move(solid.surface);
  } catch (const NoSolidError& error) {
    keep_point_report(report, findings);
    if (findings.scan_base || findings.tries.empty()) throw;
    throw NoSolidError(error.what() + advice(findings));
  } catch (...) {
    keep_point_report(report, findings);
    throw;
  }
}

}  // namespace meshrepair
