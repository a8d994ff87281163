#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <picture/texture.h>

namespace meshrepair {
namespace {

constexpr Rgba kRed = {255, 0, 0, 255}, kGreen = {0, 255, 0, 255}, kBlue = {0, 0, 255, 255},
               kWhitePixel = {255, 255, 255, 255};

// Red and green above, blue and white below.
Texture four() { return Texture({{2, 2}, {kRed, kGreen, kBlue, kWhitePixel}}); }

TEST(Texture, ItsCornersAreWhereFormatsHaveThem) {
  const Texture texture = four();
  EXPECT_EQ(texture.light(0.25, 0.75, 0), (Light{1, 0, 0}));
  EXPECT_EQ(texture.light(0.75, 0.75, 0), (Light{0, 1, 0}));
  EXPECT_EQ(texture.light(0.25, 0.25, 0), (Light{0, 0, 1}));
  EXPECT_EQ(texture.light(0.75, 0.25, 0), (Light{1, 1, 1}));
}

TEST(Texture, IsLinearBetweenPixels) {
  const Light light = four().light(0.5, 0.75, 0);
  EXPECT_EQ(light, (Light{0.5, 0.5, 0}));
}

TEST(Texture, RepeatsWithoutEnd) {
  const Texture texture = four();
  for (const double n : {-3.0, -1.0, 1.0, 1024.0}) {
    EXPECT_EQ(texture.light(0.25 + n, 0.75 - n, 0), (Light{1, 0, 0}));
  }
  EXPECT_EQ(texture.light(0, 0.75, 0), (Light{0.5, 0.5, 0}));  // between the last and the first
}

TEST(Texture, TakesAnyPlace) {
  const double inf = std::numeric_limits<double>::infinity();
  const Texture texture = four();
  for (const double u : {inf, -inf, std::nan(""), 1e300, -1e300, -1e-300, 5e-324, -5e-324}) {
    for (const double v : {0.25, inf, std::nan(""), -1e-300}) {
      for (const double value : texture.light(u, v, 0)) EXPECT_TRUE(value >= 0 && value <= 1);
    }
  }
}

TEST(Texture, CopiesGetSmallerUntilOnePixelIsTheMeanOfAll) {
  const Texture texture({{5, 3}, std::vector<Rgba>(15, Rgba{100, 200, 50, 255})});
  EXPECT_EQ(texture.copy_for(0), 0U);
  EXPECT_EQ(texture.copy_for(2), 0U);
  EXPECT_EQ(texture.copy_for(4), 1U);
  EXPECT_EQ(texture.copy_for(1e300), 2U);
  EXPECT_EQ(texture.copy_for(std::nan("")), 0U);
  EXPECT_EQ(texture.light(0.3, 0.4, 2), light_of({100, 200, 50, 255}));
  const Light mean = Texture({{2, 1}, {kRed, kBlue}}).light(0, 0, 1);
  EXPECT_NEAR(mean[0], 0.5, 0.01);
  EXPECT_NEAR(mean[2], 0.5, 0.01);
}

}  // namespace
}  // namespace meshrepair
