// SPDX-License-Identifier: MIT
#include "drains/place_drains.h"

#include <cmath>

#include <gtest/gtest.h>

#include <mesh/topology.h>

#include "shapes.h"

namespace meshrepair::internal {
namespace {

struct BoxWithCavity {
  TriangleSoup solid = testing::box({0, 0, 0}, {20, 30, 10});
  TriangleSoup walls = testing::box({1, 1, 1}, {19, 29, 9});
  Depth depth{solid};
  HollowOptions options;
  CavityPlaces cavity;

  BoxWithCavity() {
    options.wall = 1;
    options.drain = 2;
    for (double x = 1; x <= 19; x += 0.5) {
      for (double y = 1; y <= 29; y += 0.5) {
        cavity.corners.push_back(depth.place(Vec3d(x, y, 1), 0));
        cavity.corners.push_back(depth.place(Vec3d(x, y, 9), 0));
      }
    }
    for (const auto& [a, b, c] : walls.triangles) {
      cavity.triangles.push_back({walls.points[a], walls.points[b], walls.points[c]});
    }
    cavity.deepest = depth.place(Vec3d(10, 15, 5), 0);
  }
};

TEST(PlaceDrains, OneIsAtTheLowestPlaceAndOneFarFromIt) {
  const BoxWithCavity box;
  const DrainPlacer placer(box.solid, box.depth, box.options);
  const std::vector<Drill> drills = placer.for_cavity(box.cavity, {});
  ASSERT_EQ(drills.size(), 2u);
  EXPECT_EQ(drills[0].drain.at.z(), 0);
  EXPECT_EQ(drills[0].drain.direction, Vec3d(0, 0, 1));
  EXPECT_LT(drills[0].from.z(), 0);
  EXPECT_GT(drills[0].to.z(), 1);
  EXPECT_GT((drills[1].drain.at - drills[0].drain.at).norm(), 20);
}

TEST(PlaceDrains, UpIsAnotherAxis) {
  BoxWithCavity box;
  box.options.up = Vec3d(0, 0, -1);
  const DrainPlacer placer(box.solid, box.depth, box.options);
  EXPECT_EQ(placer.for_cavity(box.cavity, {}).at(0).drain.at.z(), 10);
}

TEST(PlaceDrains, OneIsWhereItIsAskedFor) {
  const BoxWithCavity box;
  const DrainPlacer placer(box.solid, box.depth, box.options);
  const auto drill = placer.from_point(Vec3d(5, 6, -40), box.cavity, {});
  ASSERT_TRUE(drill);
  EXPECT_EQ(drill->drain.at, Vec3d(5, 6, 0));
}

TEST(PlaceDrains, TheyKeepTheWallFromOtherFaces) {
  BoxWithCavity box;
  for (const double drain : {0.1, 1.0, 2.0, 4.0, 7.9}) {
    box.options.drain = drain;
    const DrainPlacer placer(box.solid, box.depth, box.options);
    const std::vector<Drill> drills = placer.for_cavity(box.cavity, {});
    ASSERT_FALSE(drills.empty());
    EXPECT_EQ(drills[0].drain.at.z(), 0);
    for (const Drill& drill : drills) {
      EXPECT_GE(drill.drain.beside, 0.98);
      std::vector<double> room;  // of the axis to the planes of faces
      for (Eigen::Index k = 0; k < 3; ++k) {
        if (std::abs(drill.drain.direction[k]) > 0.5) continue;
        const double high = Vec3d(20, 30, 10)[k];
        room.push_back(std::min(drill.drain.at[k], high - drill.drain.at[k]));
      }
      ASSERT_EQ(room.size(), 2U);
      for (const double one : room) EXPECT_GE(one, 0.98 + drain / 2);
    }
  }
}

// As soon as the whole section is in the cavity.
TEST(PlaceDrains, TheyEndBehindTheWall) {
  const BoxWithCavity box;
  const DrainPlacer placer(box.solid, box.depth, box.options);
  for (const Drill& drill : placer.for_cavity(box.cavity, {})) {
    const double length = (drill.to - drill.drain.at).norm();
    EXPECT_GT(length, 1.02);
    EXPECT_LT(length, 1.05);
  }
}

TEST(PlaceDrains, ByHandTheyStayAndTellWhatTheyLeave) {
  const BoxWithCavity box;
  const DrainPlacer placer(box.solid, box.depth, box.options);
  const auto drill = placer.from_point(Vec3d(1.5, 6, -1), box.cavity, {});
  ASSERT_TRUE(drill);
  EXPECT_EQ(drill->drain.at, Vec3d(1.5, 6, 0));
  EXPECT_LT(drill->drain.beside, 0.5);
  EXPECT_GT(drill->drain.beside, 0.49);
  const auto out = placer.from_point(Vec3d(0.5, 6, -1), box.cavity, {});
  EXPECT_TRUE(!out || out->drain.beside < 0);
}

TEST(PlaceDrains, TheyTellHowFarFromEachOtherTheyAre) {
  const BoxWithCavity box;
  const DrainPlacer placer(box.solid, box.depth, box.options);
  const std::vector<Drill> first = {*placer.from_point(Vec3d(5, 6, -1), box.cavity, {})};
  const auto apart = placer.from_point(Vec3d(7.5, 6, -1), box.cavity, first);
  ASSERT_TRUE(apart);
  EXPECT_NEAR(placer.between(first[0], *apart), 0.5, 0.02);
  EXPECT_NEAR(apart->drain.beside, 0.5, 0.02);
  const auto over = placer.from_point(Vec3d(6, 6, -1), box.cavity, first);
  ASSERT_TRUE(over);
  EXPECT_LE(placer.between(first[0], *over), 0);
}

TEST(PlaceDrains, APrismHoldsItsCylinder) {
  const BoxWithCavity box;
  const DrainPlacer placer(box.solid, box.depth, box.options);
  const TriangleSoup prism = prism_of(placer.for_cavity(box.cavity, {}).at(0), box.options.drain);
  const Topology topology = examine_topology(prism.triangles, prism.points.size());
  EXPECT_TRUE(topology.closed() && topology.manifold() && topology.oriented());
  double length = 0;
  for (const Vec3d& p : prism.points) length = std::max(length, p.z() - prism.points[0].z());
  const double cylinder = 3.14159265 * length;
  EXPECT_GT(signed_volume(prism), cylinder);
  EXPECT_LT(signed_volume(prism), 1.01 * cylinder);
}

TEST(PlaceDrains, NoneLeadsIntoAVoid) {
  BoxWithCavity box;
  testing::append(box.solid, testing::flipped(testing::box({9, 14, 4}, {11, 16, 6})));
  const Depth depth(box.solid);
  CavityPlaces cavity;
  for (double x = 9; x <= 11; x += 0.1) cavity.corners.push_back(depth.place(Vec3d(x, 15, 3), 0));
  cavity.deepest = depth.place(Vec3d(10, 15, 2.5), 0);
  const DrainPlacer placer(box.solid, depth, box.options);
  for (const Drill& drill : placer.for_cavity(cavity, {})) EXPECT_EQ(drill.drain.at.z(), 0);
}

}  // namespace
}  // namespace meshrepair::internal
