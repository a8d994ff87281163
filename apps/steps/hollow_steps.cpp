// SPDX-License-Identifier: MIT
#include "steps/hollow_steps.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <base/stage_meter.h>
#include <check/mesh_distance.h>
#include <hollow/hollow.h>
#include <mesh/append_soup.h>
#include <repair/explain_repair.h>
#include <repair/transfer_attributes.h>

#include "options/numbers.h"
#include "pictures/picture_steps.h"
#include "report/words.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

HollowOptions options_for(const HollowRequest& request, const TriangleSoup& solid,
                          const Findings& findings) {
  HollowOptions options = request.options;
  const double diagonal = bounding_diagonal(solid);
  if (request.is_share) options.wall *= diagonal;
  if (request.is_drain_share) options.drain *= diagonal;
  for (const std::string& word : request.places) {
    options.drains_at.push_back(*vector_in(word));
    options.drain_names.push_back(word);
  }
  options.up = up_of(findings) == View::Up::y ? Vec3d::UnitY() : Vec3d::UnitZ();
  return options;
}

// Those of walls are behind those of the solid, without attributes.
Attributes with_walls(const TriangleSoup& solid, Attributes attributes, const Surface& hollowed) {
  TriangleSoup walls;
  walls.points = hollowed.mesh.points;
  Surface sources = hollowed;
  for (std::size_t t = 0; t < sources.source.size(); ++t) {
    if (sources.source[t] != Surface::kNoSource) continue;
    sources.source[t] = static_cast<std::uint32_t>(solid.triangles.size() + walls.triangles.size());
    walls.triangles.push_back(hollowed.mesh.triangles[t]);
  }
  TriangleSoup joined = solid;
  append_soup(joined, walls);
  append_attributes(attributes, solid.triangles.size(), {}, walls.triangles.size());
  return transfer_attributes(joined, attributes, sources);
}

std::string why_nothing(const HollowReport& hollow) {
  return fmt::format(
      "walls of {:.6g} leave no cavity that holds a ball of diameter {:.6g}, {}", hollow.wall,
      hollow.least_diameter,
      hollow.least_diameter == hollow.drain ? "as a drain needs" : "a quarter of the wall");
}

void warn_of_hollows(const Findings& findings) {
  const HollowReport& hollow = findings.hollow;
  const auto tell = [&](const std::string& text) {
    warn(findings.input_name(), {WarningCode::not_hollowed, text, {}});
  };
  if (hollow.cavities.empty()) tell("nothing is hollowed: " + why_nothing(hollow));
  if (hollow.unproven > 0) {
    tell(fmt::format("the thickness of the walls is not proven in {}",
                     number_of(hollow.unproven, "place")));
  }
  const auto closed =
      static_cast<std::size_t>(std::count_if(hollow.cavities.begin(), hollow.cavities.end(),
                                             [](const Cavity& cavity) { return !cavity.opens; }));
  if (hollow.drain > 0 && closed > 0) {
    tell(
        fmt::format("{} without a drain: nowhere does one of that diameter lead in without "
                    "breaking out beside its mouth",
                    number_of(closed, "cavity is", "cavities are")));
  }
  const double enough = (1 - kHollowError) * hollow.wall;
  std::size_t thin = 0;
  for (const Cavity& cavity : hollow.cavities) {
    thin += static_cast<std::size_t>(
        std::count_if(cavity.drains.begin(), cavity.drains.end(),
                      [&](const Drain& drain) { return drain.beside < enough; }));
  }
  if (thin > 0) {
    tell(fmt::format("the wall beside {} is thinner, {:.3g} at the least", number_of(thin, "drain"),
                     hollow.beside_drains));
  }
}

// Of a triangle, wherever its corners begin.
std::array<std::array<double, 3>, 3> corners_of(const TriangleSoup& soup, std::size_t triangle) {
  std::array<std::array<double, 3>, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& p = soup.points[soup.triangles[triangle][i]];
    corners[i] = {p.x(), p.y(), p.z()};
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

// Sources are still those of the solid. A triangle that a drain goes through is in pieces; the
// walls of cavities and drains are walls.
void explain_walls(const TriangleSoup& solid, const Surface& hollowed,
                   RepairExplanation& explanation) {
  if (explanation.origins.empty()) return;
  std::vector<TriangleOrigin> origins;
  origins.reserve(hollowed.source.size());
  for (std::size_t t = 0; t < hollowed.source.size(); ++t) {
    const std::uint32_t source = hollowed.source[t];
    if (source == Surface::kNoSource) {
      origins.push_back(TriangleOrigin::wall);
      continue;
    }
    const bool is_whole = corners_of(hollowed.mesh, t) == corners_of(solid, source);
    const TriangleOrigin before = explanation.origins[source];
    origins.push_back(before == TriangleOrigin::whole && !is_whole ? TriangleOrigin::piece
                                                                   : before);
  }
  explanation.origins = std::move(origins);
}

}  // namespace

void HollowRequest::scale_and_move(double factor, const Findings& findings) {
  if (!is_share) options.wall *= factor;
  if (!is_drain_share) options.drain *= factor;
  for (const std::string& word : std::exchange(places, {})) {
    Vec3d place = factor * *vector_in(word);
    if (findings.origin) place -= *findings.origin;
    options.drains_at.push_back(place);
    options.drain_names.push_back(word);
  }
}

void add_hollow_options(CommandLine& app, HollowRequest& request) {
  const CommandOption* const hollow = add_length_option(
      app, "--hollow", request.options.wall, request.is_share,
      "Make cavities in the repaired solid, so that its walls have this thickness: in\n"
      "units of IN, or as a percentage of the bounding box diagonal, such as 2%.\n"
      "The thickness is proven within 2 %. The outer surface does not change",
      "Repair");
  const CommandOption* const drain =
      add_length_option(
          app, "--drain", request.options.drain, request.is_drain_share,
          "With --hollow, drill drain holes of this diameter: for each cavity one at its\n"
          "lowest place, and one far from it. Cavities that are too small for them stay full.\n"
          "Without it, cavities are closed",
          "Repair")
          ->needs(hollow);
  app.add_option("--drain-at", request.places,
                 "Drill a drain hole from the place of the surface that is nearest to this point\n"
                 "into the nearest cavity, instead of those that would be there; may be repeated")
      ->check([](const std::string& word) {
        return vector_in(word) ? std::string() : word + " is no point: three numbers X,Y,Z";
      })
      ->needs(drain)
      ->one_each_time()
      ->type_name("X,Y,Z")
      ->group("Repair");
}

void hollow_stage(const HollowRequest& request, const RepairOptions& options, Surface& surface,
                  Attributes& attributes, Run& run, Findings& findings) {
  if (!request.options.wanted()) return;
  RepairOptions quiet = options;
  quiet.progress = &run.progress;
  HollowReport made;
  Surface hollowed =
      hollow(surface, options_for(request, surface.mesh, findings), quiet, made, findings.repair);
  findings.hollow = std::move(made);  // of one that was stopped, nothing is told
  if (!findings.hollow.cavities.empty()) {
    if (!attributes.is_bare()) {
      attributes = with_walls(surface.mesh, std::move(attributes), hollowed);
    }
    explain_walls(surface.mesh, hollowed, findings.repair.explanation);
    for (std::uint32_t& source : hollowed.source) {
      if (source != Surface::kNoSource) source = surface.source[source];
    }
    surface = std::move(hollowed);
  }
  warn_of_hollows(findings);
}

}  // namespace meshrepair
