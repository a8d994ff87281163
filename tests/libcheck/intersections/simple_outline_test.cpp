// SPDX-License-Identifier: MIT
#include "intersections/simple_outline.h"

#include <array>
#include <initializer_list>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <exact/double_predicates.h>

#include "each_seed.h"

namespace meshrepair::internal {
namespace {

// Loops of corners in the plane of x and y, one after the other.
class Loops {
 public:
  Loops(std::initializer_list<std::vector<std::array<double, 2>>> loops) {
    for (const auto& loop : loops) add(loop);
  }

  void add(const std::vector<std::array<double, 2>>& loop) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    const auto count = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      points_.emplace_back(loop[i][0], loop[i][1], i % 5);
      sides_.push_back({first + i, first + (i + 1) % count});
    }
  }

  // Corner `from` is the same as corner `to`.
  void join(std::uint32_t from, std::uint32_t to) {
    for (auto& side : sides_) {
      for (std::uint32_t& p : side) p = p == from ? to : p;
    }
  }

  [[nodiscard]] std::vector<OutlineEdge> edges() const {
    std::vector<OutlineEdge> edges;
    for (const auto& [from, to] : sides_) {
      edges.push_back({from, to, &points_[from], &points_[to]});
    }
    return edges;
  }

  // With the inside on the left, and on the right.
  [[nodiscard]] std::array<bool, 2> simple() const {
    return {is_simple_outline(edges(), 2, 1), is_simple_outline(edges(), 2, -1)};
  }

 private:
  std::vector<Vec3d> points_;
  std::vector<std::array<std::uint32_t, 2>> sides_;
};

constexpr std::array kLeft = {true, false}, kRight = {false, true}, kNeither = {false, false};

TEST(SimpleOutline, IsOneThatGoesRoundOnce) {
  EXPECT_EQ(Loops({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}).simple(), kLeft);
  EXPECT_EQ(Loops({{{0, 0}, {0, 1}, {1, 1}, {1, 0}}}).simple(), kRight);
  EXPECT_EQ(Loops({{{0, 0}, {3, 1}, {6, 0}, {3, 8}}, {{9, 0}, {10, 0}, {9, 1}}}).simple(), kLeft);
}

TEST(SimpleOutline, HasHolesTurnedTheOtherWay) {
  const std::vector<std::array<double, 2>> outer = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  EXPECT_EQ(Loops({outer, {{1, 1}, {1, 2}, {2, 2}, {2, 1}}}).simple(), kLeft);
  EXPECT_EQ(Loops({outer, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}}).simple(), kNeither);
  EXPECT_EQ(Loops({outer, {{1, 1}, {1, 8}, {8, 8}, {8, 1}}, {{2, 2}, {3, 2}, {3, 3}}}).simple(),
            kLeft);
}

TEST(SimpleOutline, MeetsItselfAtCornersAlone) {
  EXPECT_EQ(Loops({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}).simple(), kNeither);          // crosses
  EXPECT_EQ(Loops({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}}).simple(), kNeither);  // touches
  EXPECT_EQ(Loops({{{0, 0}, {4, 0}, {2, 0}, {2, 3}}}).simple(), kNeither);          // overlaps
  EXPECT_EQ(Loops({{{0, 0}, {0, 4}, {0, 2}, {3, 2}}}).simple(), kNeither);          // upright
  EXPECT_EQ(Loops({{{0, 0}, {2, 0}, {1, 1}}, {{1, 1}, {2, 2}, {0, 2}}}).simple(), kNeither);
}

TEST(SimpleOutline, MayHaveACornerTwice) {
  Loops two({{{0, 0}, {2, 0}, {1, 1}}, {{1, 1}, {2, 2}, {0, 2}}});
  two.join(3, 2);
  EXPECT_EQ(two.simple(), kLeft);
  Loops hole({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{0, 0}, {1, 3}, {3, 1}}});
  hole.join(4, 0);
  EXPECT_EQ(hole.simple(), kLeft);
}

// Random loops on a small grid, where most of them meet, beside all pairs of edges and a count of
// how often they wind around the middles between grid points.
TEST(SimpleOutline, IsWhatComparingAllEdgesFinds) {
  std::array<std::size_t, 2> seen{};
  for_each_seed(1, 3000, [&](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto pick = [&](int most) { return std::uniform_int_distribution<int>(0, most)(random); };
    Loops loops{};
    for (int loop = pick(1); loop >= 0; --loop) {
      std::vector<std::array<double, 2>> corners;
      for (int i = 3 + pick(2); i > 0; --i) corners.push_back({double(pick(6)), double(pick(6))});
      loops.add(corners);
    }
    const std::vector<OutlineEdge> edges = loops.edges();
    const auto turn = [](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
      return orientation_along(2, a, b, c);
    };
    bool meets = false;
    for (const OutlineEdge& e : edges) {
      if ((*e.from_at - *e.to_at).head<2>().isZero(0)) return;  // none of a triangle
      for (const OutlineEdge& f : edges) {
        const bool share = e.from == f.to || e.to == f.from;
        if (&e == &f ||
            (share && turn(*e.from_at, *e.to_at, e.to == f.from ? *f.to_at : *f.from_at) != 0)) {
          continue;
        }
        const bool across =
            turn(*e.from_at, *e.to_at, *f.from_at) * turn(*e.from_at, *e.to_at, *f.to_at) <= 0 &&
            turn(*f.from_at, *f.to_at, *e.from_at) * turn(*f.from_at, *f.to_at, *e.to_at) <= 0;
        const auto apart = [&](Eigen::Index k) {
          return std::max((*e.from_at)[k], (*e.to_at)[k]) <
                     std::min((*f.from_at)[k], (*f.to_at)[k]) ||
                 std::max((*f.from_at)[k], (*f.to_at)[k]) <
                     std::min((*e.from_at)[k], (*e.to_at)[k]);
        };
        meets |= across && !apart(0) && !apart(1) &&
                 !(share &&
                   (*e.from_at - *e.to_at).head<2>().dot((*f.from_at - *f.to_at).head<2>()) > 0);
      }
    }
    int least = 0, most = 0;
    for (int i = 0; i < 60 * 60; ++i) {  // far from all lines through two grid points, or nearly so
      const Vec3d at(0.05 + 0.1 * (i % 60) + 1e-4, 0.05 + 0.1 * (i / 60 % 60) + 3e-4, 0);
      int winding = 0;
      for (const OutlineEdge& e : edges) {
        const bool up = e.from_at->y() <= at.y() && e.to_at->y() > at.y();
        const bool down = e.to_at->y() <= at.y() && e.from_at->y() > at.y();
        const int side = up || down ? turn(*e.from_at, *e.to_at, at) : 0;
        winding += up && side > 0 ? 1 : down && side < 0 ? -1 : 0;
      }
      least = std::min(least, winding);
      most = std::max(most, winding);
    }
    const bool expected = !meets && least == 0 && most == 1;
    EXPECT_EQ(is_simple_outline(edges, 2, 1), expected) << "seed " << seed;
    ++seen[expected ? 1 : 0];
  });
  EXPECT_GT(seen[0], 0u);
  EXPECT_GT(seen[1], 0u);
}

}  // namespace
}  // namespace meshrepair::internal
