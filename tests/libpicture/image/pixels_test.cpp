// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <picture/pixels.h>

namespace meshrepair {
namespace {

TEST(Beside, PutsABarBetweenTwo) {
  const Rgba a = {1, 1, 1, 255}, b = {2, 2, 2, 255}, bar = {3, 3, 3, 255};
  const Pixels both = beside(filled({2, 2}, a), filled({1, 2}, b), 1, bar);
  EXPECT_EQ(both.size, (PictureSize{4, 2}));
  EXPECT_EQ(both.values, (std::vector<Rgba>{a, a, bar, b, a, a, bar, b}));
}

}  // namespace
}  // namespace meshrepair
