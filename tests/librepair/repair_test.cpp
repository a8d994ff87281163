// SPDX-License-Identifier: MIT
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/precision.h>
#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

void expect_solid(const RepairResult& result) {
  const Topology t =
      examine_topology(result.surface.mesh.triangles, result.surface.mesh.points.size());
  EXPECT_TRUE(t.closed());
  EXPECT_TRUE(t.manifold());
  EXPECT_TRUE(t.oriented());
  EXPECT_EQ(result.report.clip.fallbacks(), 0u);
  EXPECT_EQ(result.report.tree.lost_fragments, 0u);
}

TEST(Repair, ExampleInTheHeaderCertifiesWhatStlHolds) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {0.3, 0.4, 0.5}));
  soup.triangles.pop_back();
  // As in repair/repair.h.
  meshrepair::RepairOptions options;
  options.certify.precision = meshrepair::Precision::float32;
  options.certify.welded = true;
  const meshrepair::RepairResult result = meshrepair::repair(soup, options);
  if (!result.report.certify.passed()) throw std::runtime_error("not certified");
  const meshrepair::TriangleSoup& solid = result.surface.mesh;
  expect_solid(result);
  for (const Vec3d& p : solid.points) EXPECT_EQ(p, rounded_to_float32(p));
}

TEST(Repair, CubeStaysACube) {
  const RepairResult result = repair(cube());
  expect_solid(result);
  EXPECT_EQ(result.surface.mesh.triangles.size(), 12u);
  EXPECT_EQ(result.surface.mesh.points.size(), 8u);
  EXPECT_DOUBLE_EQ(result.report.output_volume, 1);
}

// Joined they share the two ends of the edge, with a vertex for each of the two copies in between.
TEST(Repair, CubesThatShareAnEdgeAreSeparatedOrJoined) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {1, 1, 0}));
  const RepairResult apart = repair(soup);
  expect_solid(apart);
  EXPECT_EQ(apart.report.output.parts, 2u);
  EXPECT_EQ(apart.surface.mesh.points.size(), 16u);
  RepairOptions options;
  options.extract.touching = Touching::join;
  const RepairResult joined = repair(soup, options);
  expect_solid(joined);
  EXPECT_EQ(joined.report.output.parts, 1u);
  EXPECT_EQ(joined.surface.mesh.points.size(), 16u);
  EXPECT_TRUE(joined.report.certify.passed());
  EXPECT_DOUBLE_EQ(joined.report.output_volume, 2);
}

// Radii through the tip of a cone would cut each triangle of its base into very many pieces.
TEST(Repair, BaseOfAConeFallsIntoFewPieces) {
  const RepairResult result = repair(cone(2000));
  expect_solid(result);
  EXPECT_LT(result.report.cover.split_facets, 12000u);
}

// Counts how often each stage asks; the last time is on the way to the next stage.
class CountingObserver : public ProgressObserver {
 public:
  void stage(std::string_view name) override { stage_ = name; }
  bool cancelled() override {
    ++asked[stage_];
    return false;
  }
  std::map<std::string, int> asked;

 private:
  std::string stage_;
};

TEST(Repair, EveryLongStageAsksWhetherToGoOn) {
  CountingObserver observer;
  RepairOptions options;
  options.progress = &observer;
  options.all_cells = true;
  (void)repair(sphere(2000), options);
  for (const char* stage : {"clean", "tree", "orient", "cells", "cover", "links", "inside"}) {
    EXPECT_GT(observer.asked[stage], 1) << stage;
  }
}

TEST(Repair, NothingEnclosedIsNoSolid) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  soup.triangles = {{0, 1, 2}};
  EXPECT_THROW((void)repair(soup), NoSolidError);
  EXPECT_THROW((void)repair(TriangleSoup{}), NoSolidError);
}

}  // namespace
}  // namespace meshrepair
