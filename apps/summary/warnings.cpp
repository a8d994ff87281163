// SPDX-License-Identifier: MIT
#include "summary/warnings.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "report/thickness_report.h"
#include "report/words.h"
#include "summary/volumes_words.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

// What noise hides does not come back.
void warn_of_lost_triangles(const Findings& findings) {
  constexpr double kWorthAWarning = 0.02;
  const SewReport& sew = findings.repair.sew;
  const auto all = static_cast<double>(findings.repair.clean.triangles_in);
  if (static_cast<double>(sew.lost_triangles) <= kWorthAWarning * all) return;
  warn(findings.input_name(),
       {WarningCode::detail_lost,
        fmt::format("corners that belong together are up to {:.3g} apart, and {} are smaller than "
                    "that: what they showed is lost",
                    sew.widest_gap, number_of(sew.lost_triangles, "triangle")),
        {{"gap", sew.widest_gap}, {"triangles", sew.lost_triangles}}});
}

// What open sheets do not enclose is gone; the user may have meant walls.
void warn_of_lost_surface(const Findings& findings) {
  constexpr double kWorthAWarning = 0.1;
  const RepairReport& repair = findings.repair;
  if (!std::isfinite(repair.input_area)) return;
  if (repair.lost_area <= kWorthAWarning * repair.input_area) return;
  const double share = std::min(1.0, repair.lost_area / repair.input_area);
  warn(findings.input_name(),
       {WarningCode::area_lost,
        fmt::format("{:.0f} % of the input area encloses nothing and is not in the result; "
                    "--thicken makes walls of open sheets",
                    100 * share),
        {{"share", share}, {"area", repair.lost_area}}});
}

// A solid made of an open sheet is mostly made up; the user may have meant something else.
void warn_of_made_up_surface(const Findings& findings) {
  const RepairReport& repair = findings.repair;
  if (findings.scan_base) return;  // asked for
  constexpr double kWorthAWarning = 0.3;
  if (!std::isfinite(repair.output_area)) return;
  if (repair.closing_area <= kWorthAWarning * repair.output_area) return;
  const double share = repair.closing_area / repair.output_area;
  warn(findings.input_name(),
       {WarningCode::area_made_up,
        fmt::format("{:.0f} % of the result's surface is patches: is the input a sheet, or part of "
                    "a larger object?",
                    100 * share),
        {{"share", share}, {"area", repair.closing_area}}});
}

// A solid that was sound is another one now, and a purpose may have asked for that.
void warn_of_filled_walls(const Findings& findings) {
  const SealReport& seal = findings.repair.seal;
  if (seal.double_walls == 0) return;
  warn(findings.input_name(),
       {WarningCode::hollow_filled,
        fmt::format("the hollow of {} is filled, volume {:.6g}, as only {} up to {:.3g} wide {} "
                    "into it; --seal none leaves it",
                    number_of(seal.double_walls, "double wall"), seal.filled_volume,
                    number_of(seal.openings, "pinhole"), seal.size,
                    seal.openings == 1 ? "leads" : "lead"),
        {{"double_walls", seal.double_walls},
         {"volume", seal.filled_volume},
         {"openings", seal.openings},
         {"size", seal.size}}});
}

// Of what there was before `area` of it went.
double share_of_surface(double area, const RepairReport& repair) {
  return area > 0 ? area / (area + repair.output_area) : 0;
}

// A purpose may have asked for that, and whoever subtracts volumes for their hollows.
void warn_of_filled_difference(const Findings& findings) {
  const std::size_t voids = findings.repair.inside.filled_voids;
  if (voids == 0 || !findings.mesh_read || !is_difference(findings.mesh_read->volumes)) return;
  warn(findings.input_name(),
       {WarningCode::hollow_filled,
        fmt::format("{} filled after negative volumes were subtracted; --cavities keep leaves "
                    "what they hollow out",
                    number_of(voids, "void")),
        {{"voids", voids}}});
}

void warn_of_poking_walls(const Findings& findings) {
  constexpr double kWorthAWarning = 0.01;
  const InsideReport& inside = findings.repair.inside;
  if (inside.poking_share < kWorthAWarning) return;
  warn(findings.input_name(),
       {WarningCode::wall_pokes_out,
        fmt::format("the wall of a cavity pokes out of the surrounding solid by {:.2g} % of its "
                    "area; --inside solidity fills the cavity",
                    100 * inside.poking_share),
        {{"share", inside.poking_share}}});
}

void warn_of_unknown_parts(const Findings& findings) {
  const KeepPartsReport& keep = findings.repair.keep;
  if (keep.done || !keep.asked) return;
  warn(findings.output_name(),
       {WarningCode::parts_all_kept,
        "all parts stay, as a surface that is not closed does not tell solids apart"});
}

std::string reasons_of(const DecimationReport& why) {
  std::vector<std::string> reasons;
  const auto add = [&](std::size_t count, const char* reason) {
    if (count > 0) reasons.push_back(fmt::format("{} ({})", reason, count));
  };
  add(why.would_meet, "make triangles intersect");
  add(why.would_fold, "fold them over");
  add(why.would_change_topology, "change the topology");
  add(why.would_part, "exceed --max-error");
  add(why.would_break_seam, "move ends of seams of textures or materials");
  if (reasons.empty()) return "no more edges can be collapsed";
  return fmt::format("collapsing more edges would {}", fmt::join(reasons, ", or "));
}

void warn_of_triangles_left(const Findings& findings) {
  const RepairReport& repair = findings.repair;
  const FewerTrianglesReport& fewer = repair.fewer;
  const std::size_t left = fewer.after;
  const bool too_many = fewer.asked > 0 && left > fewer.asked;
  if (fewer.before == 0 || (fewer.done && !fewer.is_unproven && !too_many)) return;
  const std::string why =
      !fewer.done ? "no triangles are taken away, as the result is not certified"
      : fewer.is_unproven
          ? "no triangles are taken away, as none could be within --max-error for sure"
          : fmt::format("{} stay, not {}: {}", number_of(left, "triangle"), fewer.asked,
                        reasons_of(fewer.collapses));
  warn(findings.output_name(),
       {WarningCode::triangles_left, why, {{"asked", fewer.asked}, {"triangles", left}}});
}

// Where that is much: in single precision other numbers would have kept it.
void warn_of_coarse_numbers(const Findings& findings) {
  const RepairReport& repair = findings.repair;
  constexpr double kWorthAWarning = 0.01;
  const auto tell = [&](WarningCode code, std::string_view what, double share) {
    if (!(share > kWorthAWarning)) return;
    const std::string_view why =
        repair.precision == Precision::float32
            ? "OBJ, OFF and PLY in double precision hold finer ones"
            : "sheets were nearer to each other than two steps of the working grid";
    warn(findings.output_name(),
         {code,
          fmt::format("{}, {:.0f} % of the surface: {}", what, 100 * share, why),
          {{"share", share}}});
  };
  tell(WarningCode::thin_parts_lost, "parts that are too thin for its numbers are left out",
       repair.certify.dropped_share + share_of_surface(repair.fins_area, repair));
  tell(WarningCode::slits_filled, "slits that are too narrow for its numbers are filled",
       share_of_surface(repair.slits_area, repair));
}

}  // namespace

void warn_of_coarse_grid(const Findings& findings) {
  const CleanReport& clean = findings.repair.clean;
  if (clean.dropped_below_grid == 0) return;
  warn(findings.input_name(),
       {WarningCode::below_grid,
        fmt::format("{} of {} triangles dropped: smaller than the step of the working grid, "
                    "{:.3g}. Is a point far away from the others?",
                    clean.dropped_below_grid, clean.triangles_in, clean.grid_unit),
        {{"triangles", clean.dropped_below_grid}, {"step", clean.grid_unit}}});
}

void warn_of_thin_places(const Findings& findings) {
  if (!findings.thin || findings.thin->thin_area == 0) return;
  const ThinReport& thin = *findings.thin;
  warn(findings.output_name(),
       {WarningCode::thin,
        fmt::format("{:.3g} % of the surface is thinner than {:.6g}: {}",
                    100 * thin.thin_area / thin.area, thin.limit, thin_counts(thin)),
        {{"limit", thin.limit}, {"area", thin.thin_area}}});
}

void warn_of_findings(Findings& findings) {
  if (std::exchange(findings.told, true)) return;
  warn_of_coarse_grid(findings);
  warn_of_lost_triangles(findings);
  warn_of_lost_surface(findings);
  warn_of_made_up_surface(findings);
  warn_of_filled_walls(findings);
  warn_of_filled_difference(findings);
  warn_of_poking_walls(findings);
  warn_of_unknown_parts(findings);
  warn_of_triangles_left(findings);
  warn_of_coarse_numbers(findings);
  warn_of_thin_places(findings);
}

}  // namespace meshrepair
