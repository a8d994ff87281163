// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <picture/view.h>

namespace meshrepair {
namespace {

TEST(ViewOf, KnowsNames) {
  ASSERT_TRUE(view_of("front"));
  EXPECT_EQ(view_of("front")->azimuth, 0);
  EXPECT_EQ(view_of("left")->azimuth, 270);
  EXPECT_EQ(view_of("bottom")->elevation, -90);
  EXPECT_EQ(view_of("iso")->azimuth, 45);
}

TEST(ViewOf, TakesTwoAngles) {
  const auto view = view_of("-30,12.5");
  ASSERT_TRUE(view);
  EXPECT_EQ(view->azimuth, -30);
  EXPECT_EQ(view->elevation, 12.5);
}

TEST(ViewOf, RefusesWhatIsNoView) {
  for (const char* text : {"", "Front", "front,1", "1", "1,", ",1", "1,2,3", "1, 2", "nan,0",
                           "0,inf", "0,90.5", "0,-91", "1e999,0"}) {
    EXPECT_FALSE(view_of(text)) << text;
  }
}

}  // namespace
}  // namespace meshrepair
