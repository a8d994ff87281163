// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <check/check_surface.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using testing::append;
using testing::box;
using testing::cube;
using testing::flipped;
using testing::moved;

std::size_t count(const SurfaceCheck& check, Defect defect) { return check[defect].count; }

std::size_t all_defects(const SurfaceCheck& check) {
  std::size_t sum = 0;
  for (const DefectPlaces& places : check.defects) sum += places.count;
  return sum;
}

// Boxes within each other, each turned the right way.
TriangleSoup nested_boxes(int boxes) {
  TriangleSoup soup;
  for (int i = 0; i < boxes; ++i) {
    const TriangleSoup shell = box(Vec3d::Constant(i), Vec3d::Constant(20 - i));
    append(soup, i % 2 == 0 ? shell : flipped(shell));
  }
  return soup;
}

TEST(CheckSurface, FindsNothingWrongWithSoundShapes) {
  for (const TriangleSoup& soup : {cube(), testing::sphere(3000), testing::torus(30, 12),
                                   testing::cone(20), nested_boxes(1), nested_boxes(4)}) {
    const SurfaceCheck check = check_surface(soup);
    EXPECT_EQ(all_defects(check), 0u);
    EXPECT_TRUE(check.valid_solid());
  }
}

TEST(CheckSurface, MeasuresVolumeAndArea) {
  const SurfaceCheck check = check_surface(nested_boxes(2));
  EXPECT_DOUBLE_EQ(check.volume, 8000 - 18 * 18 * 18);
  EXPECT_DOUBLE_EQ(check.area, 6 * (400 + 18 * 18));
  EXPECT_EQ(check.points, 16u);
  EXPECT_EQ(check.triangles, 24u);
  EXPECT_EQ(check.edges, 36u);
}

TEST(CheckSurface, KnowsCavitiesAndWhatIsInThem) {
  const SurfaceCheck check = check_surface(nested_boxes(5));
  ASSERT_EQ(check.parts.size(), 5u);
  EXPECT_EQ(check.cavities, 2u);
  for (std::uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(check.parts[i].depth, i);
    EXPECT_EQ(check.parts[i].facing, i % 2 == 0 ? 1 : -1);
    EXPECT_EQ(check.parts[i].first_triangle, 12 * i);
    EXPECT_TRUE(check.parts[i].closed);
  }
}

// Points exactly above each other, rays along edges and through corners.
TEST(CheckSurface, NestingHoldsForRaysThroughEdgesAndCorners) {
  TriangleSoup soup = box({0, 0, 0}, {4, 4, 4});
  append(soup, flipped(box({1, 1, 1}, {3, 3, 3})));
  append(soup, box({2, 2, 2}, {2.5, 2.5, 2.5}));
  append(soup, box({0, 0, 5}, {4, 4, 6}));
  append(soup, box({0, 0, -6}, {4, 4, -5}));
  append(soup, box({1, 1, 8}, {2, 2, 9}));
  append(soup, box({4, 0, -20}, {8, 4, -10}));
  const SurfaceCheck check = check_surface(soup);
  std::vector<std::uint32_t> depths;
  for (const SurfacePart& part : check.parts) depths.push_back(part.depth);
  EXPECT_EQ(depths, (std::vector<std::uint32_t>{0, 1, 2, 0, 0, 0, 0}));
  EXPECT_TRUE(check.valid_solid());
}

// Whatever triangle of a part comes first, and whatever corner of it.
template <class Check>
void for_each_start(const TriangleSoup& part, Check check) {
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      SCOPED_TRACE(std::to_string(t) + " from corner " + std::to_string(corner));
      TriangleSoup turned = part;
      std::swap(turned.triangles[0], turned.triangles[t]);
      auto& first = turned.triangles[0];
      std::rotate(first.begin(), first.begin() + corner, first.end());
      check(turned);
    }
  }
}

// At all corners, edges, and both; a ray from a corner that touches has to know on which side its
// part goes on.
TEST(CheckSurface, PartsThatTouchFromOutsideAreNotInEachOther) {
  const TriangleSoup outer = cube();
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (std::abs(x) + std::abs(y) + std::abs(z) < 2) continue;  // itself, or a common face
        for_each_start(moved(cube(), {x * 1.0, y * 1.0, z * 1.0}), [&](const TriangleSoup& part) {
          TriangleSoup soup = outer;
          append(soup, part);
          EXPECT_TRUE(check_surface(soup).valid_solid()) << x << ' ' << y << ' ' << z;
        });
      }
    }
  }
}

TEST(CheckSurface, CavitiesThatTouchTheWallAreStillInside) {
  const TriangleSoup outer = box({0, 0, 0}, {8, 8, 8});
  const std::vector<Vec3d> corners = outer.points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      // Along an edge of the box; others would run through its faces.
      if ((corners[i] - corners[j]).norm() != 8) continue;
      TriangleSoup cavity{{corners[i], corners[j], {3, 4, 5}, {5, 3, 4}},
                          {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 1}}, {{1, 3, 2}}}};
      if (check_surface(cavity).volume > 0) cavity = flipped(cavity);
      for_each_start(cavity, [&](const TriangleSoup& part) {
        TriangleSoup soup = outer;
        append(soup, part);
        const SurfaceCheck check = check_surface(soup);
        EXPECT_EQ(check.cavities, 1u);
        EXPECT_TRUE(check.valid_solid());
      });
    }
  }
}

TEST(CheckSurface, FindsPartsThatAreInsideOut) {
  EXPECT_EQ(count(check_surface(flipped(cube())), Defect::inside_out_part), 1u);
  TriangleSoup soup = nested_boxes(1);
  append(soup, box({1, 1, 1}, {2, 2, 2}));
  const SurfaceCheck check = check_surface(soup);
  EXPECT_EQ(count(check, Defect::inside_out_part), 1u);
  EXPECT_EQ(check[Defect::inside_out_part].first[0].ids[0], 12u);
  EXPECT_FALSE(check.outward());
  EXPECT_FALSE(check.valid_solid());
}

TEST(CheckSurface, CallsCrossingPartsInsideOutOnlyIfTheySurelyAre) {
  TriangleSoup soup = box({0, 0, 0}, {2, 2, 2});
  append(soup, box({1, 1, 1}, {3, 3, 3}));
  EXPECT_EQ(count(check_surface(soup), Defect::inside_out_part), 0u);
  EXPECT_EQ(count(check_surface(flipped(soup)), Defect::inside_out_part), 1u);
}

TEST(CheckSurface, FindsHolesAndFlips) {
  TriangleSoup soup = cube();
  soup.triangles.pop_back();
  SurfaceCheck check = check_surface(soup);
  EXPECT_EQ(count(check, Defect::open_edge), 3u);
  EXPECT_FALSE(check.closed());
  EXPECT_FALSE(check.parts[0].closed);
  soup = cube();
  std::swap(soup.triangles[0][0], soup.triangles[0][1]);
  check = check_surface(soup);
  EXPECT_EQ(count(check, Defect::inconsistent_edge), 3u);
  EXPECT_FALSE(check.oriented());
  EXPECT_FALSE(check.valid_solid());
  for (const Place& place : check[Defect::inconsistent_edge].first) {
    EXPECT_LT(place.ids[0], place.ids[1]);
  }
}

TEST(CheckSurface, FindsEdgesAndPointsThatAreNotManifold) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {1, 1, 0}));  // shares an edge, once welded
  SurfaceCheck check = check_surface(soup);
  EXPECT_EQ(all_defects(check), 0u);
  CheckOptions options;
  options.weld = true;
  check = check_surface(soup, options);
  EXPECT_EQ(count(check, Defect::nonmanifold_edge), 1u);
  EXPECT_EQ(count(check, Defect::self_intersection), 0u);
  EXPECT_EQ(check.parts.size(), 1u);
  EXPECT_TRUE(check.parts[0].closed);
  EXPECT_EQ(check.parts[0].facing, 1);
  soup = cube();
  append(soup, moved(cube(), {1, 1, 1}));  // a corner
  check = check_surface(soup, options);
  EXPECT_EQ(count(check, Defect::nonmanifold_vertex), 1u);
  EXPECT_EQ(check[Defect::nonmanifold_vertex].first[0].at, Vec3d(1, 1, 1));
  EXPECT_FALSE(check.manifold());
}

TEST(CheckSurface, FindsBadTrianglesAndPoints) {
  TriangleSoup soup = cube();
  soup.points.emplace_back(0, 0, std::numeric_limits<double>::quiet_NaN());
  soup.points.emplace_back(7, 7, 7);
  soup.points.emplace_back(2, 0, 0);
  soup.triangles.push_back({0, 1, 8});
  soup.triangles.push_back({0, 0, 1});
  soup.triangles.push_back({0, 1, 10});
  soup.triangles.push_back(soup.triangles[2]);
  std::swap(soup.triangles.back()[0], soup.triangles.back()[1]);
  const SurfaceCheck check = check_surface(soup);
  EXPECT_EQ(count(check, Defect::not_finite_triangle), 1u);
  EXPECT_EQ(count(check, Defect::degenerate_triangle), 2u);
  EXPECT_EQ(count(check, Defect::duplicate_triangle), 1u);
  EXPECT_EQ(check[Defect::duplicate_triangle].first[0].ids, (std::array<std::uint32_t, 2>{2, 15}));
  EXPECT_EQ(count(check, Defect::unused_point), 1u);
  EXPECT_EQ(check[Defect::unused_point].first[0].at, Vec3d(7, 7, 7));
}

TEST(CheckSurface, AnUnusedPointIsNoFault) {
  TriangleSoup soup = cube();
  soup.points.emplace_back(7, 7, 7);
  EXPECT_TRUE(check_surface(soup).valid_solid());
}

TEST(CheckSurface, NothingIsNoSolid) {
  EXPECT_FALSE(check_surface({}).valid_solid());
  // Closed, and encloses nothing.
  const TriangleSoup flat = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 2, 1}}}};
  const SurfaceCheck check = check_surface(flat);
  EXPECT_TRUE(check.closed());
  EXPECT_FALSE(check.outward());
  EXPECT_FALSE(check.valid_solid());
}

TEST(CheckSurface, MarksTheTrianglesOfEachDefect) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {5, 0, 0}));
  soup.triangles.erase(soup.triangles.begin() + 23);
  append(soup, box({-1, 0.25, 0.25}, {0.5, 0.5, 0.5}));
  CheckOptions options;
  options.mark_triangles = true;
  options.most_places = 0;
  const SurfaceCheck check = check_surface(soup, options);
  ASSERT_EQ(check.marks.size(), soup.triangles.size());
  std::size_t open = 0, crossing = 0;
  for (const std::uint16_t mark : check.marks) {
    open += (mark >> static_cast<unsigned>(Defect::open_edge)) & 1;
    crossing += (mark >> static_cast<unsigned>(Defect::self_intersection)) & 1;
  }
  EXPECT_EQ(open, 3u);
  EXPECT_GE(crossing, 6u);
  EXPECT_TRUE(check[Defect::open_edge].first.empty());
}

TEST(CheckSurface, KeepsTheFirstPlaces) {
  const TriangleSoup soup = testing::without_some(testing::sphere(20000), 0.3, 1);
  CheckOptions options;
  options.most_places = 5;
  const SurfaceCheck check = check_surface(soup, options);
  const DefectPlaces& open = check[Defect::open_edge];
  EXPECT_GT(open.count, 5000u);
  ASSERT_EQ(open.first.size(), 5u);
  EXPECT_EQ(open.first[0].ids[0], 0u);
  options.most_places = open.count;
  const SurfaceCheck all = check_surface(soup, options);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(all[Defect::open_edge].first[i].ids, open.first[i].ids);
  }
}

}  // namespace
}  // namespace meshrepair
