// SPDX-License-Identifier: MIT
#include "picture/terminal_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/base64.h>
#include <picture/png_io.h>

namespace meshrepair {
namespace {

using Percent = std::array<int, 3>;

// What a terminal draws of sixels.
class Sixels {
 public:
  explicit Sixels(const std::string& text) : text_(text) {
    const std::string head = "\x1bP0;1;0q\"1;1;";
    EXPECT_EQ(text_.substr(0, head.size()), head);
    EXPECT_EQ(text_.substr(text_.size() - 2), "\x1b\\");
    at_ = head.size();
    width_ = number();
    ++at_;
    height_ = number();
    drawn_.resize(width_ * height_, -1);
    while (at_ < text_.size() - 2) step();
  }

  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t height() const { return height_; }
  [[nodiscard]] std::size_t colours() const { return colours_.size(); }
  [[nodiscard]] Percent at(std::size_t x, std::size_t y) const {
    return colours_.at(static_cast<std::size_t>(drawn_.at(y * width_ + x)));
  }
  [[nodiscard]] bool all_drawn() const {
    return std::find(drawn_.begin(), drawn_.end(), -1) == drawn_.end();
  }

 private:
  std::size_t number() {
    std::size_t value = 0;
    while (text_[at_] >= '0' && text_[at_] <= '9') {
      value = 10 * value + static_cast<std::size_t>(text_[at_++] - '0');
    }
    return value;
  }

  void step() {
    const char what = text_[at_++];
    if (what == '#') return take_colour();
    if (what == '$') {
      x_ = 0;
    } else if (what == '-') {
      x_ = 0;
      top_ += 6;
    } else if (what == '!') {
      const std::size_t run = number();
      put(text_[at_++], run);
    } else {
      put(what, 1);
    }
  }

  void take_colour() {
    colour_ = static_cast<int>(number());
    if (text_[at_] != ';') return;
    ++at_;
    EXPECT_EQ(number(), 2U);
    Percent percent{};
    for (int& value : percent) {
      ++at_;
      value = static_cast<int>(number());
    }
    EXPECT_EQ(static_cast<std::size_t>(colour_), colours_.size());
    colours_.push_back(percent);
  }

  void put(char sixel, std::size_t run) {
    ASSERT_GE(sixel, '?');
    ASSERT_LE(sixel, '~');
    for (std::size_t i = 0; i < run; ++i, ++x_) {
      for (std::size_t row = 0; row < 6; ++row) {
        if (((sixel - '?') >> row & 1) == 0) continue;
        ASSERT_LT(x_, width_);
        ASSERT_LT(top_ + row, height_);
        drawn_[(top_ + row) * width_ + x_] = colour_;
      }
    }
  }

  const std::string& text_;
  std::size_t at_ = 0, width_ = 0, height_ = 0, x_ = 0, top_ = 0;
  int colour_ = 0;
  std::vector<Percent> colours_;
  std::vector<int> drawn_;
};

// Of all pixels, of 255.
double largest_error(const Pixels& pixels, const Sixels& sixels) {
  double largest = 0;
  for (std::size_t y = 0; y < pixels.size.height; ++y) {
    for (std::size_t x = 0; x < pixels.size.width; ++x) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double drawn = sixels.at(x, y)[i] * 2.55;
        largest = std::max(largest, std::abs(drawn - pixels.at(x, y)[i]));
      }
    }
  }
  return largest;
}

Pixels random_pixels(PictureSize size, std::uint32_t shades, std::uint32_t seed) {
  std::mt19937 random(seed);
  Pixels pixels = filled(size, {0, 0, 0, 255});
  for (Rgba& pixel : pixels.values) {
    for (std::size_t i = 0; i < 3; ++i) {
      pixel[i] = static_cast<std::uint8_t>(random() % shades * 255 / std::max(shades - 1, 1U));
    }
  }
  return pixels;
}

TEST(TerminalText, FewColoursAreDrawnAsTheyAre) {
  for (const PictureSize size : {PictureSize{1, 1}, PictureSize{1, 13}, PictureSize{700, 6},
                                 PictureSize{31, 5}, PictureSize{20, 12}}) {
    const Pixels pixels = random_pixels(size, 2, size.width);
    const std::string text = format_sixel(pixels);
    const Sixels sixels(text);
    EXPECT_EQ(sixels.width(), size.width);
    EXPECT_EQ(sixels.height(), size.height);
    ASSERT_TRUE(sixels.all_drawn());
    EXPECT_LE(sixels.colours(), 8U);
    EXPECT_LT(largest_error(pixels, sixels), 1.3);  // half a percent
  }
}

TEST(TerminalText, ManyColoursBecomeTheNearest) {
  const Pixels pixels = random_pixels({200, 120}, 12, 1);
  const std::string text = format_sixel(pixels);
  const Sixels sixels(text);
  ASSERT_TRUE(sixels.all_drawn());
  EXPECT_EQ(sixels.colours(), 256U);
  EXPECT_LT(largest_error(pixels, sixels), 120);
}

TEST(TerminalText, RunsAreShort) {
  EXPECT_EQ(format_sixel(filled({1000, 6}, {255, 0, 0, 255})),
            "\x1bP0;1;0q\"1;1;1000;6#0;2;100;0;0#0!1000~-\x1b\\");
}

TEST(TerminalText, KittyGetsThePngInPieces) {
  for (const PictureSize size : {PictureSize{1, 1}, PictureSize{100, 80}}) {
    const Pixels pixels = random_pixels(size, 256, 2);
    const std::string text = format_kitty(pixels);
    const std::regex piece("\x1b_G(a=T,f=100,q=2,)?m=([01]);([A-Za-z0-9+/=]*)\x1b\\\\");
    std::string data;
    std::size_t end = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), piece); at != std::sregex_iterator();
         ++at) {
      EXPECT_EQ(static_cast<std::size_t>(at->position()), end);
      EXPECT_EQ((*at)[1].matched, end == 0);
      end += static_cast<std::size_t>(at->length());
      EXPECT_EQ((*at)[2] == "0", end == text.size());
      EXPECT_LE(at->length(3), 4096);
      data += (*at)[3];
    }
    EXPECT_EQ(end, text.size());
    EXPECT_EQ(decode_base64(data), format_png(pixels));
  }
}

}  // namespace
}  // namespace meshrepair
