// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/parallel.h>
#include <check/self_intersections.h>

#include "each_seed.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

SelfIntersections by_index(const TriangleSoup& soup) {
  SelfIntersectionOptions options;
  options.weld = false;
  return self_intersections(soup, options);
}

SelfIntersections with_all_pairs(const TriangleSoup& soup) {
  SelfIntersectionOptions options;
  options.most_pairs = std::numeric_limits<std::uint32_t>::max();
  return self_intersections(soup, options);
}

TEST(SelfIntersections, CleanShapesHaveNone) {
  EXPECT_EQ(self_intersections(testing::cube()).count, 0u);
  EXPECT_EQ(self_intersections(testing::sphere(5000)).count, 0u);
  EXPECT_EQ(self_intersections(testing::torus(40, 20)).count, 0u);
  EXPECT_EQ(self_intersections(testing::cone(30)).count, 0u);
  EXPECT_EQ(self_intersections({}).count, 0u);
}

TEST(SelfIntersections, OfCrossingSpheresLieInBothParts) {
  const TriangleSoup soup = testing::two_overlapping_spheres(2000);
  const SelfIntersections found = with_all_pairs(soup);
  EXPECT_GT(found.count, 100u);
  EXPECT_EQ(found.count, found.crossing);
  EXPECT_EQ(found.pairs.size(), found.count);
  EXPECT_TRUE(std::is_sorted(found.pairs.begin(), found.pairs.end()));
  const std::size_t half = soup.triangles.size() / 2;
  for (const auto& [a, b] : found.pairs) {
    EXPECT_LT(a, half);
    EXPECT_GE(b, half);
  }
}

// Of the last triangle of the soup with all others.
std::size_t near_the_last(const TriangleSoup& soup, double nearness) {
  SelfIntersectionOptions options;
  options.nearness = nearness;
  const std::array last = {static_cast<std::uint32_t>(soup.triangles.size() - 1)};
  return self_intersections(soup, last, options).coplanar;
}

TEST(SelfIntersections, OfSheetsThatNearlyLieOnEachOther) {
  const TriangleSoup apart = {
      {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {1, 1, 1e-9}, {1, -2, 1e-9}, {-2, 1, 1e-9}},
      {{{0, 1, 2}}, {{3, 4, 5}}}};
  EXPECT_EQ(near_the_last(apart, 0), 0u);
  EXPECT_EQ(near_the_last(apart, 1e-10), 0u);
  EXPECT_EQ(near_the_last(apart, 2e-9), 1u);
  const TriangleSoup folded = {{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.4, 2, 1e-9}},
                               {{{0, 1, 2}}, {{1, 0, 3}}}};
  EXPECT_EQ(near_the_last(folded, 1e-10), 0u);
  EXPECT_EQ(near_the_last(folded, 2e-9), 1u);
  const TriangleSoup wedge = {{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 0.5, 1e-9}, {2, 0.25, 1e-9}},
                              {{{0, 1, 2}}, {{0, 3, 4}}}};
  EXPECT_EQ(near_the_last(wedge, 1e-10), 0u);
  EXPECT_EQ(near_the_last(wedge, 2e-9), 1u);
}

// In a flat sheet all lie beside each other.
TEST(SelfIntersections, OfNeighboursThatLieInOnePlane) {
  const TriangleSoup fan = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 1e-12}},
                            {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 4}}, {{0, 4, 1}}}};
  EXPECT_EQ(near_the_last(fan, 1e-9), 0u);
}

// Around a vertex with very many triangles these are told apart by their directions.
TEST(SelfIntersections, OfFansWithVeryManyTriangles) {
  EXPECT_EQ(self_intersections(testing::cone(2000)).count, 0u);
  TriangleSoup soup = testing::cone(2000);
  const auto added = static_cast<std::uint32_t>(soup.points.size());
  soup.points.emplace_back(0.3, 0.2, 0.1);
  soup.points.emplace_back(0.31, 2, -0.4);
  soup.triangles.push_back({0, added, added + 1});  // from the tip out through a side, and the base
  const SelfIntersections found = with_all_pairs(soup);
  SelfIntersections expected;
  for (std::uint32_t t = 0; t + 1 < soup.triangles.size(); ++t) {
    TriangleSoup two;
    two.points = soup.points;
    two.triangles = {soup.triangles[t], soup.triangles.back()};
    expected.count += self_intersections(two).count;
  }
  EXPECT_GT(expected.count, 1u);
  EXPECT_EQ(found.count, expected.count);
}

// A hub with a fan of triangles below it that are not concerned.
TriangleSoup with_crowded_origin(double size) {
  TriangleSoup soup;
  soup.points.emplace_back(0, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const auto base = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(size * Vec3d(1 + i, 0, -1000));
    soup.points.push_back(size * Vec3d(1 + i, 1, -1000));
    soup.triangles.push_back({0, base, base + 1});
  }
  return soup;
}

std::size_t count_with_two_more(TriangleSoup soup, const std::array<Vec3d, 4>& corners) {
  for (std::size_t i = 0; i < 4; i += 2) {
    const auto base = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(corners[i]);
    soup.points.push_back(corners[i + 1]);
    soup.triangles.push_back({0, base, base + 1});
  }
  return self_intersections(soup).count;
}

TEST(SelfIntersections, AroundAHubWithAnAngleOfNearlyAHalfTurn) {
  EXPECT_EQ(count_with_two_more(with_crowded_origin(1),
                                {Vec3d(1, 0, 0.3), Vec3d(-1, 1e-9, -0.3), Vec3d(3e-11, 1, -1e-10),
                                 Vec3d(-3e-11, 1, 1e-10)}),
            1u);
}

TEST(SelfIntersections, AroundAHubAtBothEndsOfTheRangeOfDoubles) {
  constexpr double kTiny = 0x1p-1074;
  EXPECT_EQ(count_with_two_more(with_crowded_origin(kTiny), {Vec3d(kTiny, 0, 0), Vec3d(0, 0, kTiny),
                                                             Vec3d(100 * kTiny, 2 * kTiny, 0),
                                                             Vec3d(100 * kTiny, -2 * kTiny, 0)}),
            1u);
  constexpr double kHuge = 0x1.8p1023;
  TriangleSoup soup = with_crowded_origin(0x1p1000);
  for (Vec3d& p : soup.points) p += Vec3d(-kHuge, -kHuge, kHuge);
  EXPECT_EQ(
      count_with_two_more(soup, {Vec3d(kHuge, kHuge, kHuge), Vec3d(kHuge, kHuge, 0),
                                 Vec3d(0, kHuge, 0.75 * kHuge), Vec3d(kHuge, 0, 0.75 * kHuge)}),
      1u);
}

// A book: pages around an edge, one behind another, one back to back with another, and some so
// narrow that rounding leaves nothing of their direction.
TEST(SelfIntersections, OfVeryManyTrianglesAroundAnEdge) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {0, 0, 4}};
  const auto add_page = [&](const Vec3d& tip) {
    soup.triangles.push_back({0, 1, static_cast<std::uint32_t>(soup.points.size())});
    soup.points.push_back(tip);
  };
  for (int i = 0; i < 700; ++i) add_page({i - 350.0, 1000, 1});
  EXPECT_EQ(self_intersections(soup).count, 0u);
  add_page({-500, 2000, 3});  // twice the tip of page 100
  add_page({150, -1000, 2});  // back to back with page 200
  add_page({0x1p-60, 0, 2});  // a page of its own
  add_page({0x1p-59, 0, 1});  // behind that
  const SelfIntersections found = with_all_pairs(soup);
  EXPECT_EQ(found.coplanar, 2u);
  EXPECT_EQ(found.pairs, (std::vector<std::array<std::uint32_t, 2>>{{100, 700}, {702, 703}}));
}

TEST(SelfIntersections, EqualCornersAreSharedOnlyIfWelded) {
  TriangleSoup soup;  // two triangles of a square, each with points of its own
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, -0.0}};
  soup.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(self_intersections(soup).count, 0u);
  EXPECT_EQ(by_index(soup).coplanar, 1u);
  soup.points[5] = {0, 0.5, 1};
  EXPECT_EQ(self_intersections(soup).count, 0u);
  EXPECT_EQ(by_index(soup).touching, 1u);
}

TEST(SelfIntersections, DuplicatesAndFoldsAreCoplanar) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}};
  soup.triangles = {{0, 1, 2}, {1, 0, 2}, {1, 0, 3}};
  const SelfIntersections found = self_intersections(soup);
  EXPECT_EQ(found.coplanar, 3u);
  EXPECT_EQ(found.pairs, (Pairs{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(SelfIntersections, LeavesOutWhatHasNoAreaOrNoPlace) {
  TriangleSoup soup = testing::cube();
  soup.points.emplace_back(0.5, 0.5, std::numeric_limits<double>::quiet_NaN());
  soup.points.emplace_back(0.5, 0.5, std::numeric_limits<double>::infinity());
  soup.points.emplace_back(2, 0, 0);
  soup.triangles.push_back({0, 1, 8});
  soup.triangles.push_back({0, 9, 1});
  soup.triangles.push_back({0, 1, 1});
  soup.triangles.push_back({0, 1, 10});
  const SelfIntersections found = self_intersections(soup);
  EXPECT_EQ(found.count, 0u);
  EXPECT_EQ(found.not_finite, 2u);
  EXPECT_EQ(found.degenerate, 2u);
}

// Every pair by itself.
TEST(SelfIntersections, AgreeWithAllPairsOneByOne) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const TriangleSoup soup = testing::random_soup(120, 6, seed);
    const SelfIntersections found = with_all_pairs(soup);
    Pairs expected;
    for (std::uint32_t a = 0; a < soup.triangles.size(); ++a) {
      for (std::uint32_t b = a + 1; b < soup.triangles.size(); ++b) {
        const TriangleSoup two = {soup.points, {soup.triangles[a], soup.triangles[b]}};
        if (self_intersections(two).count > 0) expected.push_back({a, b});
      }
    }
    EXPECT_EQ(found.pairs, expected);
    EXPECT_GT(found.crossing, 0u);
    EXPECT_GT(found.touching, 0u);
  }
}

TEST(SelfIntersections, WhetherThereAreAnyIsToldWithoutCountingAll) {
  SelfIntersectionOptions options;
  options.enough = 0;
  for_each_seed(1, 60, [&](std::uint64_t seed) {
    const TriangleSoup soup = testing::random_soup(8, 12, seed);
    EXPECT_EQ(self_intersections(soup, options).count > 0, self_intersections(soup).count > 0);
  });
  const TriangleSoup spheres = testing::two_overlapping_spheres(20'000);
  const std::size_t all = self_intersections(spheres).count;
  const std::size_t some = self_intersections(spheres, options).count;
  EXPECT_GT(some, 0u);
  EXPECT_LE(some, all);
}

// Over and under the triangle (0 0 0) (6 0 0) (0 6 0), with points of its own.
TriangleSoup bipyramid(const Vec3d& top, const Vec3d& bottom) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, top, bottom};
  soup.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  return soup;
}

// Each of the two goes further out on one side, so that they cross along the rim, where no triangle
// meets another.
TEST(SelfIntersections, OfSheetsThatCrossAlongACommonEdge) {
  TriangleSoup crossing = bipyramid({1, 1, 2}, {1, 1, -1});
  append(crossing, bipyramid({1, 1, 1}, {1, 1, -2}));
  const SelfIntersections found = self_intersections(crossing);
  EXPECT_EQ(found.count, 3u);
  EXPECT_EQ(found.crossing, 3u);
  ASSERT_EQ(found.pairs.size(), 3u);
  for (const auto& [a, b] : found.pairs) {
    EXPECT_LT(a, 6u);
    EXPECT_GE(b, 6u);
  }
  Random random(3);
  EXPECT_EQ(self_intersections(transformed(crossing, random_rotation(random))).count, 3u);
  EXPECT_EQ(self_intersections(flipped(crossing)).count, 3u);
  const std::vector<std::uint32_t> some = {0, 3};
  EXPECT_EQ(self_intersections(crossing, some).count, 1u);
  EXPECT_EQ(self_intersections(crossing, std::vector<std::uint32_t>{}).count, 0u);
}

// The same with one corner of the rim that has one index.
TEST(SelfIntersections, OfSheetsThatCrossAlongAnEdgeWithAnEndInCommon) {
  TriangleSoup crossing = bipyramid({1, 1, 2}, {1, 1, -1});
  append(crossing, bipyramid({1, 1, 1}, {1, 1, -2}));
  for (auto& t : crossing.triangles) std::replace(t.begin(), t.end(), 5u, 0u);
  EXPECT_EQ(self_intersections(crossing).count, 3u);
  TriangleSoup nested = bipyramid({1, 1, 2}, {1, 1, -2});
  append(nested, bipyramid({1, 1, 1}, {1, 1, -1}));
  for (auto& t : nested.triangles) std::replace(t.begin(), t.end(), 5u, 0u);
  EXPECT_EQ(self_intersections(nested).count, 0u);
}

TEST(SelfIntersections, SheetsThatTouchAlongAnEdgeHaveNone) {
  TriangleSoup nested = bipyramid({1, 1, 2}, {1, 1, -2});
  append(nested, bipyramid({1, 1, 1}, {1, 1, -1}));
  EXPECT_EQ(self_intersections(nested).count, 0u);
  append(nested, bipyramid({1, 1, 4}, {1, 1, 3}));
  EXPECT_EQ(self_intersections(nested).count, 0u);
  TriangleSoup beside = cube();
  append(beside, moved(cube(), {1, 1, 0}));
  EXPECT_EQ(self_intersections(beside).count, 0u);
}

TEST(SelfIntersections, KeepTheLowestPairsAndCountAll) {
  const TriangleSoup soup = testing::noisy_sphere(2000, 0.1, 1);
  const SelfIntersections all = with_all_pairs(soup);
  for (const std::size_t most : {0u, 1u, 17u, 400u}) {
    SelfIntersectionOptions options;
    options.most_pairs = most;
    const SelfIntersections some = self_intersections(soup, options);
    EXPECT_EQ(some.count, all.count);
    EXPECT_EQ(some.pairs,
              Pairs(all.pairs.begin(), all.pairs.begin() + static_cast<std::ptrdiff_t>(most)));
  }
}

TEST(SelfIntersections, AmongAListAreThoseThatInvolveIt) {
  const TriangleSoup soup = testing::noisy_sphere(2000, 0.1, 1);
  const std::vector<std::uint32_t> list = {7, 3, 500, 501, 502, 503, 504, 7, 1899};
  SelfIntersectionOptions options;
  options.most_pairs = std::numeric_limits<std::uint32_t>::max();
  const SelfIntersections found = self_intersections(soup, list, options);
  Pairs expected;
  const auto listed = [&](std::uint32_t t) {
    return std::find(list.begin(), list.end(), t) != list.end();
  };
  for (const auto& pair : with_all_pairs(soup).pairs) {
    if (listed(pair[0]) || listed(pair[1])) expected.push_back(pair);
  }
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(found.pairs, expected);
  EXPECT_EQ(found.count, expected.size());
  EXPECT_EQ(self_intersections(soup, {}, options).count, 0u);
}

TEST(SelfIntersections, ThreadsDoNotMatter) {
  const TriangleSoup soup = testing::noisy_sphere(20000, 0.02, 1);
  const SelfIntersections parallel = self_intersections(soup);
  const ThreadLimit one(1);
  const SelfIntersections serial = self_intersections(soup);
  EXPECT_EQ(parallel.pairs, serial.pairs);
  EXPECT_EQ(parallel.count, serial.count);
  EXPECT_GT(serial.count, serial.pairs.size());
}

class Canceller : public ProgressObserver {
 public:
  void advance(double share) override {
    EXPECT_GE(share, last_);
    last_ = share;
  }
  bool cancelled() override { return last_ > 0.3; }

 private:
  double last_ = 0;
};

TEST(SelfIntersections, CanBeCancelled) {
  Canceller canceller;
  SelfIntersectionOptions options;
  options.progress = &canceller;
  const TriangleSoup soup = testing::sphere(20000);
  EXPECT_THROW(static_cast<void>(self_intersections(soup, options)), Cancelled);
}

TEST(SelfIntersections, ScaleDoesNotMatter) {
  const TriangleSoup soup = testing::noisy_sphere(2000, 0.1, 1);
  const SelfIntersections found = self_intersections(soup);
  for (const double by : {0x1p-900, 0x1p-30, 0x1p900}) {
    EXPECT_EQ(self_intersections(testing::scaled(soup, by)).pairs, found.pairs);
  }
}

}  // namespace
}  // namespace meshrepair
