// SPDX-License-Identifier: MIT
#include "intersections/tree_comparison.h"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <check/self_intersections.h>

#include "degenerate_soups.h"
#include "each_seed.h"
#include "shapes.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kAll = 1'000'000;

class Compared {
 public:
  explicit Compared(TriangleSoup soup)
      : soup_(std::move(soup)), corners_(soup_, true), list_(corners_), tree_(list_.boxes()) {}

  Compared(const Compared&) = delete;
  Compared& operator=(const Compared&) = delete;

  [[nodiscard]] std::vector<Pair> with_oriented_boxes() const {
    SortedTriangles sorted(TriangleList(corners_), tree_);
    sorted.use_oriented_boxes();
    SelfIntersectionOptions options;
    options.most_pairs = kAll;
    std::vector<Findings> findings;
    compare(sorted, options, findings);
    return gather(findings, kAll).pairs;
  }

  [[nodiscard]] std::vector<Pair> one_by_one() const {
    std::vector<Pair> pairs;
    for (std::uint32_t a = 0; a < list_.size(); ++a) {
      for (std::uint32_t b = a + 1; b < list_.size(); ++b) {
        if (meeting_of(list_.triangle(a), list_.triangle(b)) != Meeting::apart) {
          pairs.push_back({list_.ids()[a], list_.ids()[b]});
        }
      }
    }
    return pairs;
  }

  [[nodiscard]] bool boxes_tell_little() const {
    return internal::boxes_tell_little(tree_, list_.boxes(), [](auto, auto) { return false; });
  }

 private:
  TriangleSoup soup_;
  SoupCorners corners_;
  TriangleList list_;
  BoxTree tree_;
};

// Two cones base to base, all of whose upper triangles have boxes that meet many lower ones.
TriangleSoup double_cone(std::uint32_t sides) {
  TriangleSoup soup = testing::cone(sides);
  soup.triangles.resize(sides);
  const auto tip = static_cast<std::uint32_t>(soup.points.size());
  soup.points.emplace_back(0, 0, -1);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const auto [top, a, b] = soup.triangles[i];
    soup.triangles.push_back({tip, b, a});
  }
  return soup;
}

// Long and thin, in all directions through a ball.
TriangleSoup straws(std::uint32_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<> normal;
  TriangleSoup soup;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3d middle(normal(random), normal(random), normal(random));
    const Vec3d along(normal(random), normal(random), normal(random));
    const Vec3d across(1e-3 * normal(random), 1e-3 * normal(random), 1e-3 * normal(random));
    soup.points.insert(soup.points.end(), {middle - along, middle + along, middle + across});
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

TEST(OrientedBoxes, MissNothing) {
  for (const testing::SoupFamily& family : testing::degenerate_families()) {
    for_each_seed(1, 8, [&](std::uint64_t seed) {
      const Compared compared(family.make(seed));
      EXPECT_EQ(compared.with_oriented_boxes(), compared.one_by_one())
          << family.name << ", seed " << seed;
    });
  }
  for_each_seed(1, 4, [&](std::uint64_t seed) {
    const Compared compared(straws(1500, seed));
    EXPECT_EQ(compared.with_oriented_boxes(), compared.one_by_one()) << "seed " << seed;
  });
}

TEST(OrientedBoxes, MissNothingAtAnyScaleAndFarFromTheOrigin) {
  const TriangleSoup soup = testing::random_cubes(20, 3);
  const std::vector<Pair> pairs = Compared(soup).one_by_one();
  ASSERT_GT(pairs.size(), 10u);
  for (const double scale : {0x1p-1020, 0x1p-900, 0x1p-60, 0x1p60, 0x1p900, 0x1p1018}) {
    const Compared scaled(testing::scaled(soup, scale));
    EXPECT_EQ(scaled.with_oriented_boxes(), scaled.one_by_one()) << scale;
  }
  for (const double away : {1e9, 1e15}) {
    const Compared far(testing::moved(soup, {away, -away, away}));
    EXPECT_EQ(far.with_oriented_boxes(), far.one_by_one()) << away;
  }
}

TEST(BoxesTellLittle, OfLongTrianglesAlone) {
  EXPECT_TRUE(Compared(double_cone(5000)).boxes_tell_little());
  EXPECT_TRUE(Compared(straws(5000, 1)).boxes_tell_little());
  EXPECT_FALSE(Compared(testing::sphere(10'000)).boxes_tell_little());
}

// The same by looking up each triangle among all others.
TEST(SelfIntersections, FindsWhatCrossesAConeOfVeryManySides) {
  TriangleSoup soup = double_cone(3000);
  testing::append(soup, testing::moved(testing::scaled(testing::sphere(200), 0.3), {0.9, 0, 0}));
  std::vector<std::uint32_t> all;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) all.push_back(t);
  SelfIntersectionOptions options;
  options.most_pairs = kAll;
  const SelfIntersections found = self_intersections(soup, options);
  const SelfIntersections looked_up = self_intersections(soup, all, options);
  EXPECT_GT(found.count, 100u);
  EXPECT_EQ(found.pairs, looked_up.pairs);
  EXPECT_EQ(found.crossing, looked_up.crossing);
  EXPECT_EQ(found.touching, looked_up.touching);
}

// Each upper triangle is nearly upright, and lies in the boxes of the parts of very many others.
TEST(SelfIntersections, TellsThinTrianglesApartThatAreAskew) {
  TriangleSoup soup = double_cone(4000);
  std::mt19937 random(3);
  for (Vec3d& p : soup.points) {
    if (std::abs(p.z()) < 0.5) p.z() += std::uniform_real_distribution<>(-0.4, 0.4)(random);
  }
  EXPECT_EQ(self_intersections(soup).count, 0u);
}

// Wedges that come together in one place without a common corner, and one triangle across them.
TEST(SelfIntersections, FindsWhatCrossesWedgesThatAllComeTogether) {
  TriangleSoup soup;
  const auto add = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), {a, b, c});
    soup.triangles.push_back({first, first + 1, first + 2});
  };
  constexpr int kWedges = 4000;
  for (int i = 0; i < kWedges; ++i) {
    const double angle = (1.1 + 0.3 * i / kWedges) * std::numbers::pi;
    const double x = std::cos(angle), y = std::sin(angle);
    add({0x1p-48 * x, 0x1p-48 * y, 0}, {x, y, -0.02}, {x, y, 0.02});
  }
  const double at = 0.01 * std::cos(1.25 * std::numbers::pi);
  add({at + 0.001, at - 0.001, 0}, {at - 0.001, at + 0.001, 0}, {at, at, 0.0001});
  const auto last = static_cast<std::uint32_t>(soup.triangles.size() - 1);
  const std::size_t crossed = self_intersections(soup, std::array{last}, {}).count;
  EXPECT_GT(crossed, 1000u);
  EXPECT_EQ(self_intersections(soup).count, crossed);
}

}  // namespace
}  // namespace meshrepair::internal
