// SPDX-License-Identifier: MIT
// Boolean operations on random pairs of solids, of which half share faces, edges or corners.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <boolean/boolean.h>

#include "each_seed.h"
#include "random_solids.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

// Of what the two hold together; from the rounding of new corners.
constexpr double kTolerance = 1e-7;

// In the input's units; what is not certified fails the test.
double volume_of(const std::vector<TriangleSoup>& solids, SetOperation operation,
                 RegionTest test = RegionTest::cells) {
  BooleanOptions options;
  options.test = test;
  BooleanReport report;
  const Surface surface = boolean(solids, operation, options, report);
  if (surface.mesh.triangles.empty()) return 0;
  const Topology& topology = report.result.output;
  EXPECT_TRUE(topology.closed() && topology.manifold() && topology.oriented());
  EXPECT_TRUE(report.result.certify.passed());
  EXPECT_EQ(report.result.clip.fallbacks(), 0u);
  return signed_volume(surface.mesh);
}

TriangleSoup result_of(const std::vector<TriangleSoup>& solids, SetOperation operation) {
  BooleanReport report;
  return boolean(solids, operation, {}, report).mesh;
}

class BooleanProperties : public ::testing::TestWithParam<int> {
 protected:
  static constexpr std::uint64_t kSeeds = 12;
  [[nodiscard]] std::uint64_t first_seed() const {
    return kSeeds * static_cast<std::uint64_t>(GetParam());
  }
};

TEST_P(BooleanProperties, VolumesAddUp) {
  for (std::uint64_t seed = first_seed(); seed < first_seed() + share_of_cases(kSeeds); ++seed) {
    SCOPED_TRACE(seed);
    const auto pair = random_pair(seed);
    const double a = signed_volume(pair[0]), b = signed_volume(pair[1]);
    const double near = kTolerance * (a + b);
    const double both = volume_of(pair, SetOperation::intersect);
    EXPECT_NEAR(volume_of(pair, SetOperation::unite), a + b - both, near);
    EXPECT_NEAR(volume_of(pair, SetOperation::subtract), a - both, near);
    EXPECT_NEAR(volume_of({pair[1], pair[0]}, SetOperation::subtract), b - both, near);
    EXPECT_NEAR(volume_of(pair, SetOperation::exclude), a + b - 2 * both, near);
    EXPECT_NEAR(volume_of(pair, SetOperation::intersect, RegionTest::linear_programs), both, near);
  }
}

TEST_P(BooleanProperties, SolidWithItselfAndWithNothingFollowsSetAlgebra) {
  for_each_seed(kSeeds / 3, [&](std::uint64_t third) {
    const std::uint64_t seed = first_seed() + 3 * third;
    SCOPED_TRACE(seed);
    const TriangleSoup solid = random_pair(seed)[0];
    const double volume = signed_volume(solid), near = kTolerance * volume;
    EXPECT_NEAR(volume_of({solid, solid}, SetOperation::unite), volume, near);
    EXPECT_NEAR(volume_of({solid, solid}, SetOperation::intersect), volume, near);
    EXPECT_EQ(volume_of({solid, solid}, SetOperation::subtract), 0);
    EXPECT_EQ(volume_of({solid, solid}, SetOperation::exclude), 0);
    EXPECT_NEAR(volume_of({solid, {}}, SetOperation::subtract), volume, near);
    EXPECT_NEAR(volume_of({{}, solid}, SetOperation::exclude), volume, near);
    EXPECT_EQ(volume_of({solid, {}}, SetOperation::intersect), 0);
    EXPECT_EQ(volume_of({{}, solid}, SetOperation::subtract), 0);
  });
}

// Not in either is outside of both.
TEST_P(BooleanProperties, ComplementsInABoxFollowDeMorgan) {
  const TriangleSoup all = box({-9, -9, -9}, {9, 9, 9});
  for_each_seed(kSeeds / 3, [&](std::uint64_t third) {
    const std::uint64_t seed = first_seed() + 3 * third;
    SCOPED_TRACE(seed);
    const auto pair = random_pair(seed);
    const double neither = volume_of({all, pair[0], pair[1]}, SetOperation::subtract);
    const double outside_both = volume_of({result_of({all, pair[0]}, SetOperation::subtract),
                                           result_of({all, pair[1]}, SetOperation::subtract)},
                                          SetOperation::intersect);
    EXPECT_NEAR(neither, outside_both, kTolerance * signed_volume(all));
  });
}

INSTANTIATE_TEST_SUITE_P(Pairs, BooleanProperties, ::testing::Range(0, 5));

}  // namespace
}  // namespace meshrepair
