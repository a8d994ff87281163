// SPDX-License-Identifier: MIT
#include "seal/wide_spaces.h"

#include <gtest/gtest.h>

#include "revolved.h"
#include "shapes.h"

namespace meshrepair::internal {
namespace {

using namespace testing;

bool any_behind(const TriangleSoup& soup, double diameter) {
  return WideSpaces(soup, nullptr).lie_behind(diameter);
}

TEST(WideSpaces, LieBehindPinholes) {
  for (const double hole : {0.001, 0.01, 0.1}) {
    const TriangleSoup shell = pierced_shell(hole, 0.1, 64);
    EXPECT_EQ(any_behind(shell, 0.005), hole < 0.02) << hole;
    EXPECT_TRUE(any_behind(shell, 3 * hole)) << hole;
  }
}

TEST(WideSpaces, PassableOpeningsHaveNoWideSpaceBehind) {
  EXPECT_FALSE(any_behind(pierced_shell(0.3, 0.1, 64), 0.3));
}

TEST(WideSpaces, AreWiderThanTheBall) {
  const TriangleSoup shell = pierced_shell(0.01, 0.1, 64);
  EXPECT_TRUE(any_behind(shell, 0.3));
  TriangleSoup small = scaled(shell, 0.15);
  append(small, box({2, 2, 2}, {4, 4, 4}));
  EXPECT_FALSE(any_behind(small, 0.3));
}

TEST(WideSpaces, VoidsAndSolidsAreNoWideSpaces) {
  TriangleSoup hollow = sphere(2000);
  EXPECT_FALSE(any_behind(hollow, 0.1));
  append(hollow, flipped(scaled(sphere(2000), 0.8)));
  EXPECT_FALSE(any_behind(hollow, 0.1));
  append(hollow, scaled(sphere(2000), 0.5));
  EXPECT_FALSE(any_behind(hollow, 0.1));
}

}  // namespace
}  // namespace meshrepair::internal
