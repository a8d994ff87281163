// SPDX-License-Identifier: MIT
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

TEST(Texture, CornersOfTexturesAreWhereFormatsHaveThem) {
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

TextureSampling sampling_of(TextureSampling::Wrap wrap,
                            TextureSampling::Filter filter = TextureSampling::Filter::automatic) {
  return {{wrap, wrap}, filter};
}

TEST(Texture, GoesOnAsItsEdgesWhereItIsClamped) {
  const Texture texture = four();
  const TextureSampling clamp = sampling_of(TextureSampling::Wrap::clamp);
  for (const double far : {0.75, 1.0, 1.25, 7.0, 1e300}) {
    EXPECT_EQ(texture.light(far, far, 0, clamp), (Light{0, 1, 0}));
    EXPECT_EQ(texture.light(1 - far, 1 - far, 0, clamp), (Light{0, 0, 1}));
  }
  EXPECT_EQ(texture.light(0.5, 0.75, 0, clamp), (Light{0.5, 0.5, 0}));
}

TEST(Texture, IsTurnedEverySecondTimeWhereItIsMirrored) {
  const Texture texture = four();
  const TextureSampling mirror = sampling_of(TextureSampling::Wrap::mirror);
  for (const double n : {-4.0, -2.0, 0.0, 2.0}) {
    EXPECT_EQ(texture.light(0.25 + n, 0.75 - n, 0, mirror), (Light{1, 0, 0}));
    EXPECT_EQ(texture.light(n - 0.25, 0.75, 0, mirror), (Light{1, 0, 0}));
    EXPECT_EQ(texture.light(0.25, n - 0.75, 0, mirror), (Light{1, 0, 0}));
  }
  EXPECT_EQ(texture.light(1, 0.75, 0, mirror), (Light{0, 1, 0}));
}

TEST(Texture, IsWhiteOutsideWhereThereIsNothingOfIt) {
  const Texture texture = four();
  const TextureSampling none = sampling_of(TextureSampling::Wrap::none);
  EXPECT_EQ(texture.light(0.25, 0.75, 0, none), (Light{1, 0, 0}));
  EXPECT_EQ(texture.light(1.25, 0.75, 0, none), (Light{1, 1, 1}));
  EXPECT_EQ(texture.light(0.25, -0.25, 0, none), (Light{1, 1, 1}));
}

TEST(Texture, HasThePixelsAloneWhereTheNearestCounts) {
  using Wrap = TextureSampling::Wrap;
  const Texture texture = four();
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::none}) {
    const TextureSampling nearest = sampling_of(wrap, TextureSampling::Filter::nearest);
    EXPECT_EQ(texture.light(0.4375, 0.5625, 0, nearest), (Light{1, 0, 0}));
    EXPECT_EQ(texture.light(0.5625, 0.5625, 0, nearest), (Light{0, 1, 0}));
  }
}

TEST(Texture, TakesAnyPlace) {
  const double inf = std::numeric_limits<double>::infinity();
  const Texture texture = four();
  for (const double u : {inf, -inf, std::nan(""), 1e300, -1e300, -1e-300, 5e-324, -5e-324}) {
    for (const double v : {0.25, inf, std::nan(""), -1e-300}) {
      for (const auto wrap : {TextureSampling::Wrap::repeat, TextureSampling::Wrap::mirror,
                              TextureSampling::Wrap::clamp, TextureSampling::Wrap::none}) {
        for (const auto filter :
             {TextureSampling::Filter::linear, TextureSampling::Filter::nearest}) {
          for (const double value : texture.light(u, v, 0, sampling_of(wrap, filter))) {
            EXPECT_TRUE(value >= 0 && value <= 1);
          }
        }
      }
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
