#include "common/point_steps.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include <CLI/Validators.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <base/error.h>
#include <repair/drop_small_parts.h>

#include "common/summary.h"

namespace meshrepair {
namespace {

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

// Of the triangles of a scan that is closed but for holes, most are in the result, and most of the
// result is of them. Scans of one side come to less than a third or more than half.
constexpr double kFewestKept = 0.5;
constexpr double kMostMadeUp = 0.4;

// Of the triangles between points without noise, nearly all are wanted by all three corners; with
// noise of a quarter of the spacing, half of them.
constexpr double kNoisy = 0.5;

// Share of the triangles that all three corners want.
double agreement(const PointSoupReport& soup) {
  const auto& [one, two, three] = soup.by_votes;
  return static_cast<double>(three) /
         static_cast<double>(std::max<std::size_t>(1, one + two + three));
}

std::string why_noisy(const PointSoupReport& soup) {
  const double share = agreement(soup);
  if (share >= kNoisy) return {};
  return "the points are noisy, all three corners want only " + percent(share) +
         " of the triangles: --project 3 --neighbours 30 smooths them";
}

// What is there, but is no surface for the triangulation.
constexpr double kManyUnused = 0.1;

// Of a result that is a solid, but maybe not that of the points.
void warn_of_points(const Findings& findings) {
  const PointSoupReport& soup = *findings.point_soup;
  const std::string noisy = why_noisy(soup);
  if (!noisy.empty()) spdlog::warn("{}: {}", findings.input_name(), noisy);
  const std::size_t unused = soup.points - std::min(soup.points, findings.points_in_result);
  if (static_cast<double>(unused) <= kManyUnused * static_cast<double>(soup.points)) return;
  spdlog::warn(
      "{}: {} of {} are not on the result: do they lie along lines, or inside, or is there more "
      "than one surface?",
      findings.input_name(), unused, number_of(soup.points, "point"));
}

std::string advice(const Findings& findings) {
  const std::string noisy = why_noisy(*findings.point_soup);
  if (!noisy.empty()) return "; " + noisy;
  return "; --base closes a scan that is open below, and meshrepair on what pointmesh writes "
         "closes "
         "whatever it can";
}

void require_enclosure(const RepairReport& repair) {
  const auto kept = static_cast<double>(repair.triangles.untouched + repair.triangles.cut);
  const double share = kept / static_cast<double>(repair.clean.triangles_in);
  if (share < kFewestKept) {
    throw NoSolidError(
        "the points enclose little: " + percent(1 - share) +
        " of the triangles between them are no wall of anything, as in a scan of one side");
  }
  const double made_up = repair.closing_area / repair.output_area;
  if (made_up > kMostMadeUp) {
    throw NoSolidError("the points leave too much open: " + percent(made_up) +
                       " of the surface would be made up");
  }
}

PointCloud keep(PointReadResult result, Findings& findings) {
  findings.points_read = std::move(result.report);
  log_warnings(findings.input_name(), findings.points_read->warnings);
  return std::move(result.cloud);
}

}  // namespace

void add_point_options(CLI::App& app, PointSoupOptions& options) {
  app.add_option("--votes", options.votes,
                 "Keep triangles that at least this many of their corners want: 1, 2 or 3")
      ->check(CLI::Range(1, 3))
      ->type_name("N")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--reach", options.reach,
                 "Span gaps up to this radius, in spacings of the points around them")
      ->check(CLI::Range(0.1, 1000.0))
      ->type_name("X")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--neighbours", options.neighbours,
                 "Neighbours of a point that its tangent plane is fitted to")
      ->check(CLI::Range(5, 1000))
      ->type_name("N")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--outliers", options.outlier,
                 "Drop points whose spacing is this many times that of their neighbours; 0: none")
      ->check(CLI::NonNegativeNumber)
      ->type_name("X")
      ->capture_default_str()
      ->group("Points");
  app.add_option("--project", options.project,
                 "Smooth noisy points: move each this many times onto the surface that its\n"
                 "neighbours suggest")
      ->check(CLI::Range(0, 100))
      ->type_name("N")
      ->capture_default_str()
      ->group("Points");
  app.add_flag_callback(
         "--no-normals", [&options] { options.use_normals = false; },
         "Do not use the normals of the points")
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
  PointSoup result = make_point_soup(cloud, options, findings.point_soup.emplace());
  const std::size_t most = run.options.max_triangles, count = result.soup.triangles.size();
  if (most > 0 && count > most) {
    throw LimitError(number_of(count, "triangle") + " between the points, more than " +
                     std::to_string(most));
  }
  return result;
}

void add_point_repair_options(CLI::App& app, PointOptions& options) {
  app.add_flag("--points", options.as_points,
               "Use only the points of a mesh, as if it had no faces")
      ->group("Points");
  app.add_flag("--base", options.base,
               "Close an open scan, such as a terrain, by walls down to a floor")
      ->group("Points");
  app.add_option_function<std::string>(
         "--up", [&options](const std::string& axis) { options.scan_base.axis = axis[0] - 'x'; },
         "The axis that points up from the floor: x, y or z")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->type_name("NAME")
      ->default_str("z")
      ->group("Points");
  add_point_options(app, options.soup);
}

AnySoup read_any_stage(const PointOptions& options, const ReadOptions& reading, Run& run,
                       Findings& findings) {
  PointCloud cloud;
  if (options.as_points) {
    cloud = read_points_stage(run, findings);
  } else {
    StageMeter meter(findings.repair.stages, &run.progress);
    meter.begin("read");
    MeshOrPoints input = read_mesh_or_points(findings.input, reading);
    if (input.mesh) {
      if (options.base) throw UsageError("--base: is for points; --points takes those of a mesh");
      keep_read_report(std::move(input.mesh->report), findings);
      return {std::move(input.mesh->soup),
              {},
              std::move(input.mesh->attributes),
              std::move(input.mesh->scene)};
    }
    cloud = keep(std::move(*input.points), findings);
  }
  PointSoup points = triangulate_stage(cloud, options.soup, run, findings);
  if (!options.base) return {std::move(points.soup), points.opacity(), {}, {}};
  return {with_base(points.soup, options.scan_base, findings.scan_base.emplace()), {}, {}, {}};
}

Surface repair_any(const AnySoup& input, const PointOptions& points, const RepairOptions& options,
                   Findings& findings) {
  if (!findings.point_soup) return repair(input.soup, options, findings.repair);
  RepairOptions point_options = options;
  point_options.opacity = input.opacity;
  if (findings.scan_base) {
    point_options.holes.largest_share = std::numeric_limits<double>::max();
    point_options.holes.largest_flat_share = std::numeric_limits<double>::max();
  } else {
    point_options.examine = require_enclosure;
  }
  try {
    Surface surface = repair(input.soup, point_options, findings.repair);
    findings.dropped_solids =
        drop_small_parts(surface, points.soup.fewest_triangles, findings.repair);
    findings.points_in_result = static_cast<std::size_t>(
        std::count(surface.input_point.begin(), surface.input_point.end(), 1));
    warn_of_points(findings);
    return surface;
  } catch (const NoSolidError& error) {
    if (findings.scan_base) throw;
    throw NoSolidError(error.what() + advice(findings));
  }
}

}  // namespace meshrepair
