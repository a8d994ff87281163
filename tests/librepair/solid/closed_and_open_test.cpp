// SPDX-License-Identifier: MIT
// What is closed by itself does not change for open sheets beside it.

#include <cstdint>

#include <gtest/gtest.h>

#include <repair/repair.h>

#include "each_seed.h"
#include "open_surfaces.h"
#include "shapes.h"
#include "triangles_by_place.h"

namespace meshrepair {
namespace {

using namespace testing;

// Hills, so wide.
TriangleSoup ground(double width) {
  TriangleSoup sheet = scaled(moved(wavy_sheet(8), {-2, -2, -0.3}), width / 4);
  return sheet;
}

TriangleSoup body_over(double clearance, std::uint64_t seed) {
  Random random(seed);
  TriangleSoup body = seed % 2 == 0 ? transformed(cube(), random_rotation(random)) : torus(9, 6);
  double low = 0;
  for (const Vec3d& p : body.points) low = std::min(low, p.z());
  return moved(body, {0, 0, clearance - low});
}

TEST(ClosedParts, StayAsTheyAreBesideOpenOnes) {
  for_each_seed(6, [&](std::uint64_t seed) {
    for (const double width : {3.0, 30.0, 300.0}) {
      for (const double clearance : {0.01, 1.0, 10.0}) {
        const TriangleSoup body = body_over(clearance, seed);
        TriangleSoup scene = ground(width);
        append(scene, body);
        const RepairResult result = repair(scene);
        EXPECT_EQ(triangles_by_place(result.surface.mesh), triangles_by_place(body)) << width;
        EXPECT_NEAR(result.report.lost_area, surface_area(ground(width)), 1e-3 * width * width);
      }
    }
  });
}

TEST(ClosedParts, PartWithItsOwnOpeningClosedIsClosed) {
  for (const double width : {2.0, 20.0, 200.0}) {
    TriangleSoup scene = moved(cube(), {-0.5, -0.5, 0.5});
    // The face at the top.
    std::erase_if(scene.triangles, [&](const auto& t) {
      return std::all_of(t.begin(), t.end(), [&](auto p) { return scene.points[p].z() == 1.5; });
    });
    ASSERT_EQ(scene.triangles.size(), 10u);
    append(scene, ground(width));
    EXPECT_NEAR(repair(scene).report.output_volume, 1, 1e-9) << width;
  }
}

}  // namespace
}  // namespace meshrepair
