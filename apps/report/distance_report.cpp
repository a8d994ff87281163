// SPDX-License-Identifier: MIT
#include "report/distance_report.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <spdlog/fmt/fmt.h>

#include "options/numbers.h"
#include "report/words.h"

namespace meshrepair {
namespace {

// No number where either is beyond doubles.
double share_of(double distance, double diagonal) {
  if (!std::isfinite(distance) || !std::isfinite(diagonal)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return diagonal > 0 ? distance / diagonal : 0;
}

std::string percent(double distance, double diagonal) {
  const double share = share_of(distance, diagonal);
  return std::isfinite(share) ? fmt::format("{:.4g} %", 100 * share) : "-";
}

std::string row(std::string_view name, double forth, double back, double diagonal) {
  return fmt::format("{:<12}{:>13.6g}{:>14}{:>15.6g}{:>14}\n", name, forth,
                     percent(forth, diagonal), back, percent(back, diagonal));
}

Json value_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json way_section(const OneSidedDistance& way, double diagonal) {
  const auto relative = [&](double distance) { return share_of(distance, diagonal); };
  std::optional<double> relative_bound;
  if (way.bound) relative_bound = relative(*way.bound);
  return {{"samples", way.samples},
          {"mean", way.mean},
          {"rms", way.rms},
          {"hausdorff", way.largest},
          {"bound", value_of(way.bound)},
          {"at", {way.at.x(), way.at.y(), way.at.z()}},
          {"relative",
           {{"mean", relative(way.mean)},
            {"rms", relative(way.rms)},
            {"hausdorff", relative(way.largest)},
            {"bound", value_of(relative_bound)}}}};
}

}  // namespace

void add_distance_options(CommandLine& app, DistanceOptions& options) {
  app.add_option("--samples", options.samples,
                 "Number of sample points on each mesh, uniform by area")
      ->type_name("N")
      ->check(count_between(1, 1'000'000'000))
      ->capture_default_str()
      ->group("Distance");
  app.add_option("--seed", options.seed, "Seed of the sampling")
      ->type_name("N")
      ->check(count_between(0))
      ->capture_default_str()
      ->group("Distance");
  CommandOption* bound =
      app.add_flag("--bound", options.bound,
                   "Also compute a proven upper bound, rounding included, by subdividing\n"
                   "triangles until it is close to the largest distance found")
          ->group("Distance");
  app.add_option("--bound-factor", options.bound_factor,
                 "Largest ratio of this bound to the largest distance found")
      ->type_name("F")
      ->check(number_between(1.001, 1000))
      ->capture_default_str()
      ->needs(bound)
      ->group("Distance");
}

std::string distance_table(const MeshDistance& distance) {
  const OneSidedDistance &forth = distance.forth, &back = distance.back;
  const double diagonal = distance.diagonal;
  std::string text = fmt::format("{:<12}{:>13}{:>14}{:>15}{:>14}\n", "", "A to B", "of diagonal",
                                 "B to A", "of diagonal");
  text += row("mean", forth.mean, back.mean, diagonal);
  text += row("RMS", forth.rms, back.rms, diagonal);
  text += row("Hausdorff", forth.largest, back.largest, diagonal);
  if (distance.bound()) text += row("at most", *forth.bound, *back.bound, diagonal);
  text += fmt::format("Hausdorff distance {:.6g}", distance.largest());
  if (distance.bound()) {
    text += fmt::format(" or more, at most {:.6g}", *distance.bound());
  } else {
    text += fmt::format(", as {} and all corners show",
                        number_of(forth.samples + back.samples, "sample"));
  }
  return text + fmt::format("; diagonal of A {:.6g}\n", diagonal);
}

Json distance_section(const MeshDistance& distance, const DistanceOptions& options) {
  return {{"a_to_b", way_section(distance.forth, distance.diagonal)},
          {"b_to_a", way_section(distance.back, distance.diagonal)},
          {"hausdorff", distance.largest()},
          {"bound", value_of(distance.bound())},
          {"diagonal", distance.diagonal},
          {"not_finite", distance.not_finite},
          {"seed", options.seed}};
}

Json distance_section(const Fidelity& fidelity) {
  Json kept;
  if (fidelity.kept_to_output) kept = way_section(*fidelity.kept_to_output, fidelity.diagonal);
  return {{"output_to_input", way_section(fidelity.output_to_input, fidelity.diagonal)},
          {"kept_to_output", kept},
          {"kept_triangles", fidelity.kept_triangles},
          {"kept_area", fidelity.kept_area},
          {"diagonal", fidelity.diagonal}};
}

}  // namespace meshrepair
