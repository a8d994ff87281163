#include "../../librepair/src/flat_soup.h"

#include <cstdint>

#include <gtest/gtest.h>

#include <bsp/error.h>
#include <repair/repair.h>

#include "random_geometry.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

// Triangles that lie on each other in a plane, with corners in a square of side 1.
TriangleSoup scattered_in_a_plane(Random& random, double thickness) {
  TriangleSoup soup;
  for (std::uint32_t t = 0; t < 60; ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      soup.points.emplace_back(random.real(0, 1), random.real(0, 1), random.real(0, thickness));
    }
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return soup;
}

TriangleSoup turned(const TriangleSoup& soup, Random& random) {
  return moved(transformed(soup, random_rotation(random)),
               {random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
}

bool is_flat_when_clean(const TriangleSoup& soup) {
  CleanReport report;
  return internal::is_flat(clean_soup(soup, report));
}

TEST(FlatSoup, APlaneIsFlatHoweverItIsTurned) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    EXPECT_TRUE(is_flat_when_clean(turned(scattered_in_a_plane(random, 0), random))) << seed;
  }
}

TEST(FlatSoup, WhatIsThickerThanAFewStepsIsNot) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    EXPECT_FALSE(is_flat_when_clean(turned(scattered_in_a_plane(random, 1e-6), random))) << seed;
  }
  EXPECT_FALSE(is_flat_when_clean(cube()));
}

TEST(FlatSoup, WhatOnlyTheGridMadeThickEnclosesNothing) {
  Random random(7);
  const TriangleSoup soup = turned(scattered_in_a_plane(random, 0), random);
  RepairOptions options;
  EXPECT_THROW((void)repair(soup, options), NoSolidError);
  options.inside.rule = InsideRule::parity;
  EXPECT_THROW((void)repair(soup, options), NoSolidError);
}

// It is the boundary of a solid as it is given.
TEST(FlatSoup, AThinPlateIsKept) {
  const TriangleSoup plate = box({0, 0, 0}, {1, 1, 0x1p-30});
  RepairOptions options;
  options.keep_valid = true;
  EXPECT_EQ(repair(plate, options).surface.mesh.triangles.size(), 12u);
}

}  // namespace
}  // namespace meshrepair
