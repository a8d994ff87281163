// SPDX-License-Identifier: MIT
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <exact/volume_sign.h>

#include "shapes.h"

namespace meshrepair {
namespace {

int sign_of_all(const TriangleSoup& soup) {
  std::vector<std::uint32_t> all(soup.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return volume_sign(soup.points, soup.triangles, all);
}

TEST(VolumeSign, TellsOutwardFromInward) {
  EXPECT_EQ(sign_of_all(testing::sphere(1000)), 1);
  EXPECT_EQ(sign_of_all(testing::flipped(testing::sphere(1000))), -1);
  EXPECT_EQ(sign_of_all(testing::moved(testing::cube(), {1e9, -1e9, 1e9})), 1);
  EXPECT_EQ(sign_of_all({}), 0);
}

TEST(VolumeSign, IsZeroForWhatEnclosesNothing) {
  TriangleSoup soup = testing::sphere(200);
  testing::append(soup, testing::flipped(soup));
  EXPECT_EQ(sign_of_all(soup), 0);
  soup = testing::box({0.1, 0.2, 0.3}, {0.7, 0.9, 0.3});
  EXPECT_EQ(sign_of_all(soup), 0);
}

TEST(VolumeSign, IsExactFarFromTheOrigin) {
  const double step = 0x1p-22;  // one unit in the last place there
  const Vec3d low(0x1p30 + 1, 0x1p30 + 3, 0x1p30 - 7);
  EXPECT_EQ(sign_of_all(testing::box(low, low + Vec3d::Constant(step))), 1);
  EXPECT_EQ(sign_of_all(testing::flipped(testing::box(low, low + Vec3d::Constant(step)))), -1);
}

TEST(VolumeSign, HoldsAtAnyScale) {
  for (const double by : {0x1p-1000, 0x1p-400, 0x1p400, 0x1p1000}) {
    EXPECT_EQ(sign_of_all(testing::scaled(testing::sphere(100), by)), 1);
  }
}

}  // namespace
}  // namespace meshrepair
