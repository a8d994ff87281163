// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include <repair/orient_parts.h>

#include "degenerate_soups.h"
#include "each_seed.h"
#include "open_surfaces.h"
#include "trees.h"

namespace meshrepair {
namespace {

using namespace testing;

TEST(OrientParts, AConsistentSoupIsNotChanged) {
  for (const TriangleSoup& soup : {cube(), flipped(cube()), torus(12, 9), sphere(300),
                                   without_some(sphere(300), 0.1, 1), random_cubes(5, 1)}) {
    const CleanSoup clean = cleaned(soup);
    OrientReport report;
    EXPECT_EQ(orient_parts(clean, report).winding.raw(), windings_of(clean).raw());
    EXPECT_EQ(report.turned_triangles, 0u);
    EXPECT_EQ(report.unorientable_parts, 0u);
  }
}

TEST(OrientParts, FlippedTrianglesAreTurnedBack) {
  TriangleSoup soup = torus(16, 12);
  append(soup, moved(sphere(300), {10, 0, 0}));
  const CleanSoup clean = cleaned(soup);
  for_each_seed(20, [&](std::uint64_t seed) {
    const CleanSoup turned = cleaned(with_some_flipped(soup, 0.25, seed));
    OrientReport report;
    EXPECT_EQ(orient_parts(turned, report).winding.raw(), windings_of(clean).raw());
    EXPECT_EQ(report.parts, 2u);
    EXPECT_EQ(report.unorientable_parts, 0u);
    EXPECT_GT(report.turned_triangles, 50u);
  });
}

// Area decides, not the number of triangles.
TEST(OrientParts, TheSmallerAreaIsTurned) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, -1, 0}, {5, -1, 0}};
  soup.triangles = {{0, 3, 1}, {3, 1, 4}, {0, 2, 1}};  // the large one disagrees with the first
  const CleanSoup clean = cleaned(soup);
  OrientReport report;
  const auto winding = orient_parts(clean, report).winding;
  EXPECT_EQ(report.parts, 1u);
  EXPECT_EQ(winding[TriangleId(2u)], clean.triangles[TriangleId(2u)].winding);
  EXPECT_EQ(winding[TriangleId(0u)], -clean.triangles[TriangleId(0u)].winding);
}

TEST(OrientParts, AMoebiusStripIsLeftAsItIs) {
  for (std::uint32_t n = 5; n < 12; ++n) {
    SCOPED_TRACE(n);
    TriangleSoup soup = moebius_strip(n);
    append(soup, moved(with_some_flipped(sphere(200), 0.2, n), {20, 0, 0}));
    const CleanSoup clean = cleaned(soup);
    OrientReport report;
    const auto winding = orient_parts(clean, report).winding;
    EXPECT_EQ(report.parts, 2u);
    EXPECT_EQ(report.unorientable_parts, 1u);
    EXPECT_GT(report.turned_triangles, 0u);
    for (std::uint32_t t = 0; t < 2 * n; ++t) {
      EXPECT_EQ(winding[TriangleId(t)], clean.triangles[TriangleId(t)].winding);
    }
  }
}

// Nothing can be said across an edge with an odd number of triangles.
TEST(OrientParts, EdgesWithThreeTrianglesSeparateParts) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  soup.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  OrientReport report;
  const CleanSoup clean = cleaned(soup);
  EXPECT_EQ(orient_parts(clean, report).winding.raw(), windings_of(clean).raw());
  EXPECT_EQ(report.parts, 3u);
}

// Two boxes that share an edge but overlap beside it: their wedges lie in each other.
TEST(OrientParts, AConsistentSoupWithCrowdedEdgesIsNotChanged) {
  for (const TriangleSoup& other :
       {box({1, 1, 0}, {2, 2, 1}), box({0, 0, 0}, {0.5, 0.5, 1}), box({0, 1, 0}, {1, 2, 1})}) {
    TriangleSoup soup = cube();
    append(soup, other);
    for (const TriangleSoup& s : {soup, flipped(soup)}) {
      const CleanSoup clean = cleaned(s);
      OrientReport report;
      EXPECT_EQ(orient_parts(clean, report).winding.raw(), windings_of(clean).raw());
      EXPECT_EQ(report.turned_triangles, 0u);
    }
  }
}

// A prism over a figure of eight that passes its middle edge twice: two closed halves that end
// there, joined by nothing but that edge and the flat ends.
TriangleSoup two_prisms_with_a_common_edge() {
  TriangleSoup soup;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(2, 1), std::pair(2, -1), std::pair(-2, 1),
                               std::pair(-2, -1)}) {
      soup.points.emplace_back(x, y, z);
    }
  }
  const auto add_prism = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    soup.triangles.push_back({a, c, b});
    soup.triangles.push_back({a + 5, b + 5, c + 5});
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      soup.triangles.push_back({u, v, v + 5});
      soup.triangles.push_back({u, v + 5, u + 5});
    }
  };
  add_prism(0, 2, 1);
  add_prism(0, 3, 4);
  return soup;
}

TEST(OrientParts, PartsThatAreClosedByThemselvesStaySeparate) {
  OrientReport report;
  const Orientation orientation = orient_parts(cleaned(two_prisms_with_a_common_edge()), report);
  ASSERT_EQ(report.parts, 2u);
  for (const OrientedPart& part : orientation.parts) {
    EXPECT_TRUE(part.shell);
    EXPECT_TRUE(part.believed);
    EXPECT_EQ(part.outward, 1);
  }
}

// A sheet that ends at crowded edges follows those that say which way round they are.
TEST(OrientParts, AcrossACrowdedEdgeNeighboursBoundAWedge) {
  // Four pages of a book, each of many triangles, on one spine, in a box that closes them.
  TriangleSoup soup;
  constexpr std::uint32_t kRows = 12;
  for (std::uint32_t r = 0; r <= kRows; ++r) {
    soup.points.emplace_back(0, 0, r);
    for (const auto& [x, y] :
         {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 0), std::pair(0, -1)})
      soup.points.emplace_back(20 * x, 20 * y, r);
  }
  // Pages 0 and 2 face one way round, 1 and 3 the other.
  for (std::uint32_t page = 0; page < 4; ++page) {
    for (std::uint32_t r = 0; r < kRows; ++r) {
      const std::uint32_t a = 5 * r, b = a + 1 + page, c = b + 5, d = a + 5;
      if (page % 2 == 0) {
        soup.triangles.insert(soup.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        soup.triangles.insert(soup.triangles.end(), {{a, c, b}, {a, d, c}});
      }
    }
  }
  const auto right = windings_of(cleaned(soup));
  // Half of one page is flipped: the others tell it.
  for (std::size_t page = 0; page < 4; ++page) {
    TriangleSoup damaged = soup;
    for (std::size_t i = 0; i < 2 * kRows; ++i) {
      auto& t = damaged.triangles[page * 2 * kRows + i];
      if (i % 4 < 2) std::swap(t[1], t[2]);
    }
    OrientReport report;
    EXPECT_EQ(orient_parts(cleaned(damaged), report).winding.raw(), right.raw());
    EXPECT_EQ(report.parts, 1u);
  }
}

TEST(OrientParts, DoubledFacesGetAnOrientationOfTheirOwn) {
  TriangleSoup soup = sphere(300);
  const CleanSoup right = cleaned(soup);
  append(soup, flipped(sphere(300)));
  const CleanSoup clean = cleaned(soup);
  for (const Triangle& t : clean.triangles) ASSERT_EQ(t.winding, 0);
  OrientReport report;
  const Orientation orientation = orient_parts(clean, report);
  EXPECT_EQ(orientation.winding.raw(), windings_of(right).raw());
  EXPECT_EQ(report.turned_triangles, 0u);
  EXPECT_EQ(report.doubtful_parts, 1u);
  ASSERT_EQ(orientation.parts.size(), 1u);
  EXPECT_FALSE(orientation.parts[0].believed);
}

// Some faces that are there both ways round continue those around them.
TEST(OrientParts, SomeDoubledFacesFollowTheirNeighbours) {
  TriangleSoup soup = sphere(300);
  const CleanSoup right = cleaned(soup);
  const TriangleSoup opposite = flipped(sphere(300));
  for (std::size_t t = 0; t < opposite.triangles.size(); t += 7) {
    soup.triangles.push_back(opposite.triangles[t]);
  }
  OrientReport report;
  EXPECT_EQ(orient_parts(cleaned(soup), report).winding.raw(), windings_of(right).raw());
}

TEST(OrientParts, AWallBetweenTwoSolidsStaysBothWaysRound) {
  TriangleSoup soup = box({0, 0, 0}, {1, 1, 1});
  append(soup, box({1, 0, 0}, {2, 1, 1}));
  // The same diagonal on both sides of the wall, so that its triangles are the same.
  soup.triangles[2] = {1, 3, 7};
  soup.triangles[3] = {1, 7, 5};
  soup.triangles[12] = {8, 14, 10};
  soup.triangles[13] = {8, 12, 14};
  const CleanSoup clean = cleaned(soup);
  std::size_t walls = 0;
  for (const Triangle& t : clean.triangles) walls += t.winding == 0;
  ASSERT_EQ(walls, 2u);
  OrientReport report;
  EXPECT_EQ(orient_parts(clean, report).winding.raw(), windings_of(clean).raw());
}

// A sheet that is there both ways round encloses nothing.
TEST(OrientParts, AnOpenDoubledSheetStaysBothWaysRound) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  soup.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 2, 1}, {1, 2, 3}};
  OrientReport report;
  for (const std::int32_t w : orient_parts(cleaned(soup), report).winding) EXPECT_EQ(w, 0);
}

// A patch between two boxes that are there both ways round is no reason to take them for walls.
TEST(OrientParts, PatchesMakeNoWallsOfDoubledFaces) {
  TriangleSoup soup = box({0, 0, 0}, {1, 1, 1});
  append(soup, box({1, 0, 0}, {2, 1, 1}));
  append(soup, flipped(soup));
  CleanSoup clean = cleaned(soup);
  const auto in_the_middle = [&](PointId p) { return clean.points[p].x() == 1; };
  for (Triangle& t : clean.triangles) {
    ASSERT_EQ(t.winding, 0);
    if (std::all_of(t.corners.begin(), t.corners.end(), in_the_middle)) {
      t.source = Triangle::kNoSource;
    }
  }
  OrientReport report;
  const Orientation orientation = orient_parts(clean, report);
  for (TriangleId t(0u); t < clean.triangles.end_id(); ++t.value) {
    if (clean.triangles[t].source == Triangle::kNoSource) continue;
    EXPECT_EQ(std::abs(orientation.winding[t]), 1) << t.value;
  }
}

TEST(OrientParts, AShellThatDoesNotTellIsTurnedOutward) {
  const TriangleSoup soup = sphere(300);
  const CleanSoup right = cleaned(soup);
  for_each_seed(20, [&](std::uint64_t seed) {
    OrientReport report;
    const Orientation orientation =
        orient_parts(cleaned(with_some_flipped(soup, 0.5, seed)), report);
    EXPECT_EQ(orientation.winding.raw(), windings_of(right).raw());
    EXPECT_EQ(report.doubtful_parts, 1u);
  });
}

TEST(OrientParts, NothingHasNoParts) {
  OrientReport report;
  EXPECT_EQ(orient_parts(CleanSoup{}, report).parts.size(), 0u);
  EXPECT_EQ(report.parts, 0u);
}

}  // namespace
}  // namespace meshrepair
