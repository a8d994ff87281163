// SPDX-License-Identifier: MIT
#include "intersections/height_fields.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <base/ids.h>
#include <check/internal/triangle_list.h>
#include <check/internal/triangle_pair.h>

#include "degenerate_soups.h"
#include "each_seed.h"
#include "shapes.h"

namespace meshrepair::internal {
namespace {

using Fields = std::vector<std::uint32_t>;

Fields fields_of(const TriangleSoup& soup) {
  const SoupCorners corners(soup, true);
  const TriangleList list(corners);
  return find_height_fields(list, BoxTree(list.boxes()));
}

std::size_t in_fields(const Fields& fields) {
  return fields.size() - static_cast<std::size_t>(std::count(fields.begin(), fields.end(), kNone));
}

// In the largest one.
std::size_t most_in_one(const Fields& fields) {
  std::map<std::uint32_t, std::size_t> count;
  std::size_t most = 0;
  for (const std::uint32_t field : fields) {
    if (field != kNone) most = std::max(most, ++count[field]);
  }
  return most;
}

// How many pairs in one field meet, of all of them.
std::size_t meeting_in_fields(const TriangleSoup& soup) {
  const SoupCorners corners(soup, true);
  const TriangleList list(corners);
  const Fields fields = find_height_fields(list, BoxTree(list.boxes()));
  std::size_t meeting = 0;
  for (std::uint32_t a = 0; a < list.size(); ++a) {
    for (std::uint32_t b = a + 1; b < list.size(); ++b) {
      if (fields[a] == kNone || fields[a] != fields[b]) continue;
      meeting += meeting_of(list.triangle(a), list.triangle(b)) != Meeting::apart ? 1 : 0;
    }
  }
  return meeting;
}

// A road of `steps` quadrilaterals that winds up around the z axis, 100 for each turn.
TriangleSoup spiral(std::uint32_t steps, double rise) {
  TriangleSoup soup;
  for (std::uint32_t i = 0; i <= steps; ++i) {
    const double angle = 0.02 * std::numbers::pi * i;
    const Vec3d out(std::cos(angle), std::sin(angle), 0);
    soup.points.emplace_back(out + Vec3d(0, 0, rise * i));
    soup.points.emplace_back(2 * out + Vec3d(0, 0, rise * i));
    if (i == steps) break;
    soup.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
    soup.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
  }
  return soup;
}

TEST(HeightFields, HaveNoTrianglesThatMeet) {
  for (const testing::SoupFamily& family : testing::degenerate_families()) {
    for_each_seed(1, 12, [&](std::uint64_t seed) {
      EXPECT_EQ(meeting_in_fields(family.make(seed)), 0u) << family.name << ", seed " << seed;
    });
  }
}

// A sheet whose points are moved so far that it folds over itself in places, and is torn in others.
TEST(HeightFields, HaveNoTrianglesThatMeetInSheetsThatFold) {
  for_each_seed(1, 40, [&](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    constexpr std::uint32_t kSide = 16;
    std::uniform_int_distribution<int> step(-9, 9), one_in(0, 40);
    TriangleSoup soup;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const double x = 10 * (i % kSide), y = 10 * (i / kSide);
      soup.points.emplace_back(x + step(random), y + step(random), 0.1 * step(random));
    }
    for (std::uint32_t i = 0; i + kSide < kSide * kSide; ++i) {
      if (i % kSide == kSide - 1 || one_in(random) == 0) continue;
      soup.triangles.push_back({i, i + 1, i + kSide + 1});
      soup.triangles.push_back({i, i + kSide + 1, i + kSide});
    }
    EXPECT_EQ(meeting_in_fields(soup), 0u) << seed;
    EXPECT_GT(in_fields(fields_of(soup)), 0u) << seed;
  });
}

TEST(HeightFields, OfASphereAreSix) {
  const TriangleSoup sphere = testing::sphere(5000);
  const Fields fields = fields_of(sphere);
  EXPECT_GT(10 * in_fields(fields), 9 * fields.size());
  EXPECT_LT(std::set(fields.begin(), fields.end()).size(), 40u);
}

// Whichever way it faces, and at all scales.
TEST(HeightFields, HoldOneTurnOfASpiralAndNotTwo) {
  for (const double scale : {1.0, 0x1p-200, 0x1p200}) {
    EXPECT_EQ(most_in_one(fields_of(testing::scaled(spiral(90, 1e-3), scale))), 180u);
    const Fields two = fields_of(testing::scaled(spiral(190, 1e-3), scale));
    EXPECT_GT(in_fields(two), 340u);
    EXPECT_LT(most_in_one(two), 201u);
  }
  TriangleSoup turned = spiral(90, 1e-3);
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(most_in_one(fields_of(turned)), 180u);
}

// The last step ends where the first begins, seen from above.
TEST(HeightFields, EndWhereOneTriangleIsAboveTheCornersOfAnother) {
  EXPECT_EQ(most_in_one(fields_of(spiral(99, 1e-3))), 198u);
  EXPECT_LT(most_in_one(fields_of(spiral(100, 1e-3))), 200u);
}

// A ring around a hole, and a lid that is connected with it only by one edge of three triangles.
TEST(HeightFields, MayHaveHoles) {
  TriangleSoup ring = spiral(100, 0);
  for (auto& t : ring.triangles) {
    for (std::uint32_t& p : t) p %= 200;
  }
  ring.points.resize(200);
  EXPECT_EQ(most_in_one(fields_of(ring)), 200u);
}

}  // namespace
}  // namespace meshrepair::internal
