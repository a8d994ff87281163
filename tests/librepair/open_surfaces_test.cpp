// SPDX-License-Identifier: MIT
// What bounds nothing gives a solid, or none and a reason: never anything between.
#include "open_surfaces.h"

#include <string>

#include <gtest/gtest.h>

#include <repair/repair.h>

#include "complexes.h"

namespace meshrepair {
namespace {

using namespace testing;

void expect_solid_or_reason(const TriangleSoup& soup, const RepairOptions& options) {
  RepairReport report;
  try {
    const Surface surface = repair(soup, options, report);
    expect_closed_manifold(surface.mesh);
    EXPECT_TRUE(report.certify.passed());
    EXPECT_GT(report.output_volume, 0);
    EXPECT_FALSE(report.inside.reason.empty());
  } catch (const NoSolidError& error) {
    EXPECT_FALSE(std::string(error.what()).empty());
  }
}

TEST(OpenSurfaces, GiveASolidOrAReason) {
  for (const OpenSurface& surface : open_surfaces()) {
    for (const double flipped : {0.0, 0.5}) {
      for (const HoleMode mode : {HoleMode::patch, HoleMode::extend, HoleMode::none}) {
        for (const InsideRule rule : {InsideRule::automatic, InsideRule::solidity,
                                      InsideRule::parity, InsideRule::winding}) {
          SCOPED_TRACE(surface.name + ", " + std::to_string(flipped) + " flipped, holes " +
                       std::string(hole_mode_name(mode)) + ", inside " +
                       std::string(rule_name(rule)));
          RepairOptions options;
          options.holes.mode = mode;
          options.inside.rule = rule;
          expect_solid_or_reason(with_some_flipped(surface.soup, flipped, 1), options);
        }
      }
    }
  }
}

TEST(OpenSurfaces, AreNotPatchedIntoSolids) {
  for (const OpenSurface& surface : open_surfaces()) {
    if (surface.name == "seven triangles") continue;  // wedges between pages are
    SCOPED_TRACE(surface.name);
    RepairReport report;
    try {
      (void)repair(surface.soup, {}, report);
    } catch (const NoSolidError&) {
    }
    EXPECT_EQ(report.holes.closed, 0u);
  }
}

TEST(OpenSurfaces, AKleinBottleEnclosesSpace) {
  const RepairReport report = repair(klein_bottle(40, 24)).report;
  EXPECT_EQ(report.holes.loops, 0u);
  EXPECT_GT(report.output_volume, 10);
  EXPECT_NEAR(repair(with_some_flipped(klein_bottle(40, 24), 0.5, 1)).report.output_volume,
              report.output_volume, 1e-6);
}

}  // namespace
}  // namespace meshrepair
