// SPDX-License-Identifier: MIT
#include "summary/warnings.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <spdlog/logger.h>

#include "report/words.h"
#include "terminal/logging.h"

namespace meshrepair {
namespace {

// What noise hides does not come back.
void warn_of_lost_triangles(const Findings& findings) {
  constexpr double kWorthAWarning = 0.02;
  const SewReport& sew = findings.repair.sew;
  const auto all = static_cast<double>(findings.repair.clean.triangles_in);
  if (static_cast<double>(sew.lost_triangles) <= kWorthAWarning * all) return;
  logger().warn(
      "{}: corners that belong together are up to {:.3g} apart, and {} are smaller than that: what "
      "they showed is lost",
      findings.input_name(), sew.widest_gap, number_of(sew.lost_triangles, "triangle"));
}

// What open sheets do not enclose is gone; the user may have meant walls.
void warn_of_lost_surface(const Findings& findings) {
  constexpr double kWorthAWarning = 0.1;
  const RepairReport& repair = findings.repair;
  if (!std::isfinite(repair.input_area)) return;
  if (repair.lost_area <= kWorthAWarning * repair.input_area) return;
  logger().warn(
      "{}: {:.0f} % of the input area encloses nothing and is not in the result; --thicken makes "
      "walls of open sheets",
      findings.input_name(), 100 * std::min(1.0, repair.lost_area / repair.input_area));
}

// A solid made of an open sheet is mostly made up; the user may have meant something else.
void warn_of_made_up_surface(const Findings& findings) {
  const RepairReport& repair = findings.repair;
  if (findings.scan_base) return;  // asked for
  constexpr double kWorthAWarning = 0.3;
  if (!std::isfinite(repair.output_area)) return;
  if (repair.closing_area <= kWorthAWarning * repair.output_area) return;
  logger().warn(
      "{}: {:.0f} % of the result's surface is patches: is the input a sheet, or part of a larger "
      "object?",
      findings.input_name(), 100 * repair.closing_area / repair.output_area);
}

// A solid that was sound is another one now, and a purpose may have asked for that.
void warn_of_filled_walls(const Findings& findings) {
  const SealReport& seal = findings.repair.seal;
  if (seal.double_walls == 0) return;
  logger().warn(
      "{}: the hollow of {} is filled, volume {:.6g}, as only {} up to {:.3g} wide {} into it; "
      "--seal none leaves it",
      findings.input_name(), number_of(seal.double_walls, "double wall"), seal.filled_volume,
      number_of(seal.openings, "pinhole"), seal.size, seal.openings == 1 ? "leads" : "lead");
}

// Of what there was before `area` of it went.
double share_of_surface(double area, const RepairReport& repair) {
  return area > 0 ? area / (area + repair.output_area) : 0;
}

void warn_of_poking_walls(const Findings& findings) {
  constexpr double kWorthAWarning = 0.01;
  const InsideReport& inside = findings.repair.inside;
  if (inside.poking_share < kWorthAWarning) return;
  logger().warn(
      "{}: the wall of a cavity pokes out of the surrounding solid by {:.2g} % of its area; "
      "--inside solidity fills the cavity",
      findings.input_name(), 100 * inside.poking_share);
}

void warn_of_unknown_parts(const Findings& findings) {
  const KeepPartsReport& keep = findings.repair.keep;
  if (keep.done || !keep.asked) return;
  logger().warn("{}: all parts stay, as a surface that is not closed does not tell solids apart",
                findings.output_name());
}

// Where that is much: in single precision other numbers would have kept it.
void warn_of_coarse_numbers(const Findings& findings) {
  const RepairReport& repair = findings.repair;
  constexpr double kWorthAWarning = 0.01;
  const auto warn = [&](std::string_view what, double share) {
    if (!(share > kWorthAWarning)) return;
    const std::string_view why =
        repair.precision == Precision::float32
            ? "OBJ, OFF and PLY in double precision hold finer ones"
            : "sheets were nearer to each other than two steps of the working grid";
    logger().warn("{}: {}, {:.0f} % of the surface: {}", findings.output_name(), what, 100 * share,
                  why);
  };
  warn("parts that are too thin for its numbers are left out",
       repair.certify.dropped_share + share_of_surface(repair.fins_area, repair));
  warn("slits that are too narrow for its numbers are filled",
       share_of_surface(repair.slits_area, repair));
}

}  // namespace

void warn_of_coarse_grid(const Findings& findings) {
  const CleanReport& clean = findings.repair.clean;
  if (clean.dropped_below_grid == 0) return;
  logger().warn(
      "{}: {} of {} triangles dropped: smaller than the step of the working grid, {:.3g}. Is a "
      "point far away from the others?",
      findings.input_name(), clean.dropped_below_grid, clean.triangles_in, clean.grid_unit);
}

void warn_of_findings(const Findings& findings) {
  warn_of_coarse_grid(findings);
  warn_of_lost_triangles(findings);
  warn_of_lost_surface(findings);
  warn_of_made_up_surface(findings);
  warn_of_filled_walls(findings);
  warn_of_poking_walls(findings);
  warn_of_unknown_parts(findings);
  warn_of_coarse_numbers(findings);
}

}  // namespace meshrepair
