// SPDX-License-Identifier: MIT
// Codes of what slicers paint on triangles, beside a reader of codes that is only for this.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/triangle_paint.h>

namespace meshrepair {
namespace {

using Triangle = std::array<PaintPlace, 3>;

constexpr Triangle kUnit = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

PaintPlace between(const PaintPlace& a, const PaintPlace& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

double area_of(const PaintPlace& a, const PaintPlace& b, const PaintPlace& c) {
  return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
}

// By how much of its height the place is inside.
double inside(const Triangle& t, const PaintPlace& p) {
  const double all = area_of(t[0], t[1], t[2]);
  return std::min(
      {area_of(p, t[1], t[2]) / all, area_of(t[0], p, t[2]) / all, area_of(t[0], t[1], p) / all});
}

struct PaintedPiece {
  Triangle corners;
  int state = 0;
};

// What the code makes of a triangle, one digit after the other from the end.
void divide(const std::string& code, std::size_t& rest, const Triangle& t,
            std::vector<PaintedPiece>& pieces) {
  const auto digit = [&] { return std::stoi(code.substr(--rest, 1), nullptr, 16); };
  const int first_digit = digit();
  const int sides = first_digit % 4, other = first_digit / 4;
  if (sides == 0) {
    int state = other;
    for (int more = 15; other == 3 && more == 15;) state += more = digit();
    pieces.push_back({t, state});
    return;
  }
  const auto first = static_cast<std::size_t>(other);
  const PaintPlace a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
  const PaintPlace ab = between(a, b), bc = between(b, c), ca = between(c, a);
  std::vector<Triangle> children;
  if (sides == 1) children = {{a, b, bc}, {bc, c, a}};
  if (sides == 2) children = {{a, ab, ca}, {ab, b, ca}, {b, c, ca}};
  if (sides == 3) children = {{a, ab, ca}, {ab, b, bc}, {bc, c, ca}, {ab, bc, ca}};
  std::reverse(children.begin(), children.end());
  for (const Triangle& child : children) divide(code, rest, child, pieces);
}

std::vector<PaintedPiece> pieces_in(const std::string& code, const Triangle& t = kUnit) {
  std::vector<PaintedPiece> pieces;
  if (code.empty()) return {{t, 0}};
  std::size_t rest = code.size();
  divide(code, rest, t, pieces);
  EXPECT_EQ(rest, 0u) << code;
  return pieces;
}

// -1: near to where pieces meet.
int state_in(const std::vector<PaintedPiece>& pieces, const PaintPlace& p) {
  for (const PaintedPiece& piece : pieces) {
    if (inside(piece.corners, p) > 1e-6) return piece.state;
  }
  return -1;
}

std::string random_code(std::mt19937& random, int depth) {
  const auto sides = depth > 0 ? random() % 4 : 0;
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  if (sides == 0) {
    const auto state = random() % 40;
    if (state < 3) return {kDigits[state << 2]};
    std::string code = {kDigits[(state - 3) % 15]};
    for (auto n = state - 3; n >= 15; n -= 15) code += 'F';
    return code + "C";
  }
  const auto first = sides == 3 ? 0 : random() % 3;
  std::string code(1, kDigits[sides | first << 2]);
  for (unsigned i = 0; i <= sides; ++i) code.insert(0, random_code(random, depth - 1));
  return code;
}

PaintPlace random_place(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.001, 1);
  const double a = share(random), b = share(random), c = share(random);
  return {a / (a + b + c), b / (a + b + c), c / (a + b + c)};
}

PaintPlace place_in(const Triangle& t, const PaintPlace& shares) {
  PaintPlace place = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) place[i] += shares[k] * t[k][i];
  }
  return place;
}

TEST(TrianglePaint, CornersInAnotherOrderHaveTheSamePaint) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const std::string code = random_code(random, 4);
    const auto before = pieces_in(code);
    Triangle corners = kUnit;
    std::sort(corners.begin(), corners.end());
    do {
      const std::string again = PaintCode(code).within(corners);
      const auto after = pieces_in(again, corners);
      for (int k = 0; k < 20; ++k) {
        const PaintPlace place = random_place(random);
        const int state = state_in(before, place);
        if (state < 0) continue;
        ASSERT_EQ(state_in(after, place), state) << code << " as " << again;
      }
    } while (std::next_permutation(corners.begin(), corners.end()));
    EXPECT_EQ(PaintCode(code).within(kUnit), code == "0" ? "" : code);
  }
}

TEST(TrianglePaint, PiecesHaveThePaintOfTheirPlace) {
  std::mt19937 random(2);
  int right = 0, all = 0;
  for (int i = 0; i < 300; ++i) {
    const std::string code = random_code(random, 4);
    const auto before = pieces_in(code);
    const Triangle corners = {random_place(random), random_place(random), random_place(random)};
    if (std::abs(area_of(corners[0], corners[1], corners[2])) < 0.02) continue;
    const auto after = pieces_in(PaintCode(code).within(corners), corners);
    for (int k = 0; k < 50; ++k) {
      const PaintPlace place = place_in(corners, random_place(random));
      const int state = state_in(before, place), now = state_in(after, place);
      if (state < 0 || now < 0) continue;
      ++all;
      right += state == now ? 1 : 0;
    }
  }
  EXPECT_GT(all, 5000);
  EXPECT_GT(right, 0.97 * all);
}

TEST(TrianglePaint, APieceInOneStateIsOne) {
  const Triangle small = {{{0.9, 0.05, 0.05}, {0.8, 0.1, 0.1}, {0.9, 0, 0.1}}};
  EXPECT_EQ(PaintCode("04483").within(small), "");  // at the first corner, which is read last
  EXPECT_EQ(PaintCode("48443").within(small), "4");
  EXPECT_EQ(PaintCode("0C").within(small), "0C");
  EXPECT_EQ(PaintCode("44448").within(small), "");  // no code: something is left
}

TEST(TrianglePaint, WhatIsNoCodeIsNoPaint) {
  const std::string deep = std::string(200, '4') + std::string(100, '1');
  for (const std::string code : {"", "G", "3", "F", "44F", "C", "FC", "-4", "44", deep.c_str()}) {
    EXPECT_EQ(PaintCode(code).within(kUnit), "") << code;
    EXPECT_EQ(PaintCode(code).main_state(), std::nullopt) << code;
  }
}

TEST(TrianglePaint, MainStateIsThatOfMostArea) {
  EXPECT_EQ(PaintCode("4").main_state(), 1u);
  EXPECT_EQ(PaintCode("0C").main_state(), 3u);
  EXPECT_EQ(PaintCode("1FC").main_state(), 19u);
  EXPECT_EQ(PaintCode("4881").main_state(), std::nullopt);
  EXPECT_EQ(PaintCode("481").main_state(), 1u);   // halves
  EXPECT_EQ(PaintCode("4882").main_state(), 2u);  // a half, which is read first, and two quarters
}

}  // namespace
}  // namespace meshrepair
