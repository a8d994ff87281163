// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <repair/keep_parts.h>
#include <repair/repair.h>

#include "complexes.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

// Of edge length `size`, around this point.
TriangleSoup block(double size, const Vec3d& centre = {0, 0, 0}) {
  return box(centre - Vec3d::Constant(size / 2), centre + Vec3d::Constant(size / 2));
}

// Blocks of 8 (with a void of 4, which has a block of 2 in it, which has a void of 1), 3 and 2.
TriangleSoup nested_blocks() {
  TriangleSoup soup = block(8);
  append(soup, flipped(block(4)));
  append(soup, block(2));
  append(soup, flipped(block(1)));
  append(soup, block(3, {20, 0, 0}));
  append(soup, block(2, {0, 20, 0}));
  return soup;
}

RepairResult kept(const TriangleSoup& soup, const KeepPartsOptions& keep) {
  RepairOptions options;
  options.keep = keep;
  RepairResult result = repair(soup, options);
  expect_closed_manifold(result.surface.mesh);
  EXPECT_TRUE(result.report.keep.asked);
  EXPECT_TRUE(result.report.keep.done);
  EXPECT_EQ(result.surface.source.size(), result.surface.mesh.triangles.size());
  EXPECT_EQ(result.surface.input_point.size(), result.surface.mesh.points.size());
  EXPECT_DOUBLE_EQ(result.report.output_volume, signed_volume(result.surface.mesh));
  EXPECT_EQ(result.report.output.triangles, result.surface.mesh.triangles.size());
  return result;
}

TEST(KeepParts, WhatLiesInAVoidIsNotOuter) {
  const RepairResult result = kept(nested_blocks(), {.outer = true});
  EXPECT_DOUBLE_EQ(result.report.output_volume, 512 - 64 + 27 + 8);
  EXPECT_EQ(result.report.keep.solids, 4u);
  EXPECT_EQ(result.report.keep.voids, 2u);
  const std::vector<RemovedPart>& removed = result.report.keep.removed;
  ASSERT_EQ(removed.size(), 1u);  // with the wall of its void
  EXPECT_FALSE(removed[0].is_void);
  EXPECT_DOUBLE_EQ(removed[0].volume, 8 - 1);
  EXPECT_EQ(removed[0].centre, Vec3d(0, 0, 0));
  EXPECT_EQ(removed[0].triangles, 24u);
}

TEST(KeepParts, VoidsAreFilledWithAllThatIsInThem) {
  const RepairResult result = kept(nested_blocks(), {.fill_voids = true});
  EXPECT_DOUBLE_EQ(result.report.output_volume, 512 + 27 + 8);
  const std::vector<RemovedPart>& removed = result.report.keep.removed;
  ASSERT_EQ(removed.size(), 2u);
  EXPECT_FALSE(removed[0].is_void);
  EXPECT_TRUE(removed[1].is_void);
  EXPECT_DOUBLE_EQ(removed[1].volume, 64);
}

TEST(KeepParts, LargestSolidKeepsItsVoid) {
  const RepairResult result = kept(nested_blocks(), {.most = 1});
  EXPECT_DOUBLE_EQ(result.report.output_volume, 512 - 64);
  EXPECT_EQ(result.report.keep.removed.size(), 3u);
  EXPECT_EQ(result.report.keep.removed[0].centre, Vec3d(20, 0, 0));
}

TEST(KeepParts, ManyAreTakenByVolume) {
  EXPECT_DOUBLE_EQ(kept(nested_blocks(), {.most = 2}).report.output_volume, 512 - 64 + 27);
  EXPECT_DOUBLE_EQ(kept(nested_blocks(), {.most = 3}).report.output_volume, 512 - 64 + 27 + 8);
  EXPECT_DOUBLE_EQ(kept(nested_blocks(), {.most = 9}).report.output_volume, 512 - 64 + 27 + 8 + 7);
}

TEST(KeepParts, SmallOnesAreMeasuredByTheLargest) {
  const double share = 8.0 / (512 - 64);
  EXPECT_DOUBLE_EQ(kept(nested_blocks(), {.smallest_share = share}).report.output_volume,
                   512 - 64 + 27 + 8);
  EXPECT_DOUBLE_EQ(kept(nested_blocks(), {.smallest_share = 1.01 * share}).report.output_volume,
                   512 - 64 + 27);
}

// Of a thin hollow block, less than the block in it.
TEST(KeepParts, ASolidInAVoidMayStayAlone) {
  TriangleSoup soup = block(4);
  append(soup, flipped(block(3.9)));
  append(soup, block(3));
  const RepairResult result = kept(soup, {.most = 1});
  EXPECT_DOUBLE_EQ(result.report.output_volume, 27);
  EXPECT_EQ(result.report.triangles.untouched, 12u);
  EXPECT_DOUBLE_EQ(kept(soup, {.fill_voids = true, .most = 1}).report.output_volume, 64);
}

// Where they touch along an edge, they are solids of their own, unless they are to be joined.
TEST(KeepParts, TouchingSolidsAreTheirOwn) {
  TriangleSoup soup = box({0, 0, 0}, {2, 2, 2});
  append(soup, box({2, 2, 0}, {3, 3, 1}));
  EXPECT_DOUBLE_EQ(kept(soup, {.most = 1}).report.output_volume, 8);
  TriangleSoup with_void = block(4);
  append(with_void, flipped(box({-1, -1, -1}, {1, 1, 1})));
  append(with_void, flipped(box({1, 1, -1}, {1.5, 1.5, 1})));  // touches the other void
  EXPECT_NEAR(kept(with_void, {.fill_voids = true}).report.output_volume, 64, 1e-9);
}

TEST(KeepParts, WhatIsLeftIsCounted) {
  TriangleSoup soup = block(4);
  append(soup, block(4, {2, 1, 0.5}));  // both are cut
  append(soup, block(1, {20, 0, 0}));
  RepairOptions options;
  const RepairReport all = repair(soup, options).report;
  options.keep.most = 1;
  const RepairReport one = repair(soup, options).report;
  EXPECT_EQ(one.triangles.untouched + 12, all.triangles.untouched);
  EXPECT_EQ(one.triangles.cut, all.triangles.cut);
  EXPECT_EQ(one.output.parts, 1u);
}

TEST(KeepParts, AMeshOfWhichSomethingGoesIsNotKeptAsGiven) {
  const RepairReport all = kept(nested_blocks(), {.most = 9}).report;
  EXPECT_TRUE(all.kept_valid);
  EXPECT_TRUE(all.keep.removed.empty());
  const RepairReport some = kept(nested_blocks(), {.most = 1}).report;
  EXPECT_FALSE(some.kept_valid);
  EXPECT_TRUE(some.spared_cells);
}

TEST(KeepParts, AllStaysWhereNothingIsAskedFor) {
  const RepairReport report = repair(nested_blocks()).report;
  EXPECT_FALSE(report.keep.asked);
  EXPECT_EQ(report.keep.solids, 0u);
  EXPECT_DOUBLE_EQ(report.output_volume, 512 - 64 + 27 + 8 + 7);
}

TEST(KeepParts, ASurfaceThatIsNotClosedStaysAsItIs) {
  RepairResult result = repair(cube());
  TriangleSoup& mesh = result.surface.mesh;
  mesh.triangles.pop_back();
  result.surface.source.pop_back();
  result.report.output = examine_topology(mesh.triangles, mesh.points.size());
  keep_parts(cube(), result.surface, {.most = 1}, result.report);
  EXPECT_TRUE(result.report.keep.asked);
  EXPECT_FALSE(result.report.keep.done);
  EXPECT_EQ(mesh.triangles.size(), 11u);
}

}  // namespace
}  // namespace meshrepair
