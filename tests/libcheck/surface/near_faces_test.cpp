// SPDX-License-Identifier: MIT
// Faces that nearly touch.
#include <gtest/gtest.h>

#include <check/near_faces.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

NearFacesFound near(const TriangleSoup& soup, double reach) {
  NearFacesOptions options;
  options.largest_distance = reach;
  return find_near_faces(soup, options);
}

TriangleSoup two_boxes(double apart) {
  return together(box({0, 0, 0}, {3, 3, 1}), box({1, 1, 1 + apart}, {2, 2, 2}));
}

TEST(NearFaces, BodiesThatNearlyTouchHaveAGap) {
  for (const double apart : {1e-3, -1e-3}) {
    const NearFacesFound found = near(two_boxes(apart), 1e-2);
    ASSERT_FALSE(found.gaps.empty());
    for (const NearFaces& gap : found.gaps) EXPECT_NEAR(gap.apart, 1e-3, 1e-12);
    EXPECT_TRUE(found.walls.empty());
  }
}

TEST(NearFaces, WhatIsFartherApartIsNotFound) {
  EXPECT_TRUE(near(two_boxes(1e-3), 0.9e-3).gaps.empty());
}

TEST(NearFaces, SheetOfMetalIsAWall) {
  const NearFacesFound found = near(box({0, 0, 0}, {3, 3, 1e-3}), 1e-2);
  ASSERT_FALSE(found.walls.empty());
  EXPECT_NEAR(found.walls[0].apart, 1e-3, 1e-12);
  EXPECT_TRUE(found.gaps.empty());
}

TEST(NearFaces, WallBetweenAVoidAndTheOutsideIsAWall) {
  const TriangleSoup hollow =
      together(box({0, 0, 0}, {3, 3, 3}), flipped(box({1, 1, 1}, {2, 2, 2.999})));
  const NearFacesFound found = near(hollow, 1e-2);
  EXPECT_FALSE(found.walls.empty());
  EXPECT_TRUE(found.gaps.empty());
}

TEST(NearFaces, WhatFillsAVoidHasAGap) {
  const TriangleSoup filled =
      together(together(box({0, 0, 0}, {3, 3, 3}), flipped(box({1, 1, 1}, {2, 2, 2}))),
               box({1.001, 1.001, 1.001}, {1.999, 1.999, 1.999}));
  const NearFacesFound found = near(filled, 1e-2);
  EXPECT_FALSE(found.gaps.empty());
  EXPECT_TRUE(found.walls.empty());
}

}  // namespace
}  // namespace meshrepair
