// SPDX-License-Identifier: MIT
#include "intersections/spatial_comparison.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <check/internal/triangle_list.h>
#include <check/self_intersections.h>

#include "degenerate_soups.h"
#include "each_seed.h"
#include "intersections/triangle_hubs.h"
#include "shapes.h"

namespace meshrepair::internal {
namespace {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

class Compared {
 public:
  explicit Compared(TriangleSoup soup)
      : soup_(std::move(soup)), corners_(soup_, true), list_(corners_) {
    for (std::uint32_t t = 0; t < list_.size(); ++t) triangles_.push_back(list_.triangle(t));
  }

  Compared(const Compared&) = delete;
  Compared& operator=(const Compared&) = delete;

  void use_hubs() { hubs_ = find_hubs(list_); }

  [[nodiscard]] std::optional<Pairs> in_space(ProgressObserver* progress = nullptr) const {
    const auto found = compare_in_space(list_, hubs_, progress);
    if (!found) return std::nullopt;
    Pairs pairs;
    for (const MeetingPair& pair : *found) {
      EXPECT_EQ(pair.meeting, meeting_of(triangles_[pair.a], triangles_[pair.b]));
      pairs.push_back({pair.a, pair.b});
    }
    return pairs;
  }

  [[nodiscard]] Pairs one_by_one() const {
    Pairs pairs;
    for (std::uint32_t a = 0; a < list_.size(); ++a) {
      for (std::uint32_t b = a + 1; b < list_.size(); ++b) {
        if (!hubs_.empty() && hubs_[a] != kNoHub && hubs_[a] == hubs_[b]) continue;
        if (meeting_of(triangles_[a], triangles_[b]) != Meeting::apart) {
          pairs.push_back({a, b});
        }
      }
    }
    return pairs;
  }

  [[nodiscard]] bool boxes_tell_little() const {
    return internal::boxes_tell_little(list_, hubs_, BoxTree(list_.boxes()));
  }

 private:
  TriangleSoup soup_;
  SoupCorners corners_;
  TriangleList list_;
  std::vector<CornerTriangle> triangles_;
  std::vector<std::uint32_t> hubs_;  // empty: none
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

TEST(CompareInSpace, FindsWhatComparingOneByOneFinds) {
  std::size_t given_up = 0;
  for (const testing::SoupFamily& family : testing::degenerate_families()) {
    for_each_seed(1, 8, [&](std::uint64_t seed) {
      const Compared compared(family.make(seed));
      const auto in_space = compared.in_space();
      given_up += !in_space;
      if (in_space) {
        EXPECT_EQ(in_space, compared.one_by_one()) << family.name << ", seed " << seed;
      }
    });
  }
  EXPECT_LE(given_up, 4u);
}

TEST(CompareInSpace, HoldsAtAllScalesAndFarFromTheOrigin) {
  const TriangleSoup soup = testing::random_cubes(20, 3);
  const Pairs pairs = Compared(soup).one_by_one();
  ASSERT_GT(pairs.size(), 10u);
  for (const double scale : {0x1p-900, 0x1p-60, 0x1p60, 0x1p900}) {
    EXPECT_EQ(Compared(testing::scaled(soup, scale)).in_space(), pairs) << scale;
  }
  const TriangleSoup far = testing::moved(soup, {1e9, -1e9, 1e9});
  EXPECT_EQ(Compared(far).in_space(), Compared(far).one_by_one());
}

TEST(CompareInSpace, TakesOverWhereBoxesTellLittle) {
  Compared cone(double_cone(5000));
  cone.use_hubs();
  EXPECT_TRUE(cone.boxes_tell_little());
  EXPECT_EQ(cone.in_space(), Pairs());
  Compared sphere(testing::sphere(10'000));
  sphere.use_hubs();
  EXPECT_FALSE(sphere.boxes_tell_little());
}

// The same by looking up each triangle among all others.
TEST(CompareInSpace, FindsWhatCrossesAConeOfVeryManySides) {
  TriangleSoup soup = double_cone(3000);
  testing::append(soup, testing::moved(testing::scaled(testing::sphere(200), 0.3), {0.9, 0, 0}));
  std::vector<std::uint32_t> all;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) all.push_back(t);
  SelfIntersectionOptions options;
  options.most_pairs = 1'000'000;
  const SelfIntersections found = self_intersections(soup, options);
  const SelfIntersections looked_up = self_intersections(soup, all, options);
  EXPECT_GT(found.count, 100u);
  EXPECT_EQ(found.pairs, looked_up.pairs);
  EXPECT_EQ(found.crossing, looked_up.crossing);
  EXPECT_EQ(found.touching, looked_up.touching);
}

// Each upper triangle is nearly upright, and lies in the boxes of the parts of very many others.
TEST(CompareInSpace, TellsThinTrianglesApartThatAreAskew) {
  TriangleSoup soup = double_cone(4000);
  std::mt19937 random(3);
  for (Vec3d& p : soup.points) {
    if (std::abs(p.z()) < 0.5) p.z() += std::uniform_real_distribution<>(-0.4, 0.4)(random);
  }
  Compared spikes(soup);
  spikes.use_hubs();
  EXPECT_TRUE(spikes.boxes_tell_little());
  EXPECT_EQ(spikes.in_space(), Pairs());
}

// Wedges that come together in the highest place of all, without a common corner, and one triangle
// across them near that: too much to be compared there, and the last place that is looked at.
TEST(CompareInSpace, GivesUpBeforeItMissesAnything) {
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
  for (int i = 0; i < 20'000; ++i) {
    const double x = -1 + 0.004 * (i % 200), y = -1 + 0.004 * (i / 200);
    add({x, y, -0.5}, {x + 0.002, y, -0.5}, {x, y + 0.002, -0.5});
  }
  const double at = 0.01 * std::cos(1.25 * std::numbers::pi);
  add({at + 0.001, at - 0.001, 0}, {at - 0.001, at + 0.001, 0}, {at, at, 0.0001});
  const auto last = static_cast<std::uint32_t>(soup.triangles.size() - 1);
  const std::size_t crossed = self_intersections(soup, std::array{last}, {}).count;
  EXPECT_GT(crossed, 1000u);
  EXPECT_EQ(self_intersections(soup).count, crossed);
}

TEST(CompareInSpace, StopsWhenItIsToldTo) {
  class Stop : public ProgressObserver {
   public:
    bool cancelled() override { return true; }
  };
  Stop stop;
  EXPECT_THROW((void)Compared(testing::sphere(20'000)).in_space(&stop), Cancelled);
}

}  // namespace
}  // namespace meshrepair::internal
