// SPDX-License-Identifier: MIT
// Bodies with room between them, and others.
#include "seal/bodies_apart.h"

#include <vector>

#include <gtest/gtest.h>

#include "shapes.h"

namespace meshrepair::internal {
namespace {

using namespace meshrepair::testing;

// Unit boxes with these lowest corners.
std::vector<std::uint32_t> groups_of(const std::vector<Vec3d>& places, double gap, bool is_share) {
  TriangleSoup soup;
  for (const Vec3d& at : places) append(soup, box(at, at + Vec3d(1, 1, 1)));
  const MeshParts bodies = bodies_apart(soup, gap, is_share);
  std::vector<std::uint32_t> of_box;
  for (std::size_t b = 0; b < places.size(); ++b) of_box.push_back(bodies.of_triangle[12 * b]);
  return of_box;
}

using Groups = std::vector<std::uint32_t>;

TEST(BodiesApart, AreDividedWhereTheGapIsWideEnough) {
  const std::vector<Vec3d> row = {{10, 0, 0}, {0, 0, 0}, {11.5, 0, 0}};
  EXPECT_EQ(groups_of(row, 0.4, false), (Groups{0, 1, 2}));
  EXPECT_EQ(groups_of(row, 0.5, false), (Groups{0, 1, 0}));
  EXPECT_EQ(groups_of(row, 9, false), (Groups{0, 0, 0}));
}

TEST(BodiesApart, AreDividedAlongOneAxisAfterTheOther) {
  const std::vector<Vec3d> corner = {{0, 0, 0}, {0, 5, 0}, {5, 0, 0}, {5, 0.5, 5}, {0.5, 5.5, 0}};
  EXPECT_EQ(groups_of(corner, 1, false), (Groups{0, 1, 2, 3, 1}));
}

TEST(BodiesApart, AShareIsThatOfTheLargestPart) {
  const std::vector<Vec3d> row = {{0, 0, 0}, {1.3, 0, 0}, {2.8, 0, 0}};
  EXPECT_EQ(groups_of(row, 0.25, true), (Groups{0, 0, 1}));  // more than 0.433
  TriangleSoup beside = box({0, 0, 0}, {1, 1, 1});
  append(beside, box({1.5, 0, 0}, {2.5, 1, 1}));
  append(beside, box({-9, 0, 0}, {-1, 1, 1}));
  EXPECT_EQ(bodies_apart(beside, 0.25, true).count, 1u);  // as it is to be more than 2
}

TEST(BodiesApart, BoxesThatAPlaneDoesNotPartAreNot) {
  const auto unit_box = [](double x, double y) {
    Box box;
    box.add(Vec3d(x, y, 0));
    box.add(Vec3d(x + 1, y + 1, 1));
    return box;
  };
  const std::vector<Box> apart = {unit_box(0, 0), unit_box(1.5, 0.5), unit_box(0, 2)};
  EXPECT_TRUE(are_apart(apart));
  const std::vector<Box> touching = {unit_box(0, 0), unit_box(1, 0)};
  EXPECT_FALSE(are_apart(touching));
}

}  // namespace
}  // namespace meshrepair::internal
