// SPDX-License-Identifier: MIT
#include <array>
#include <limits>

#include <gtest/gtest.h>

#include <base/error.h>
#include <check/check_surface.h>
#include <mesh/precision.h>
#include <repair/repair.h>
#include <repair/valid_solid.h>

#include "degenerate_soups.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

CertifyOptions welded() {
  CertifyOptions options;
  options.welded = true;
  return options;
}

CertifyOptions single_precision() {
  CertifyOptions options;
  options.precision = Precision::float32;
  return options;
}

bool is_valid(const TriangleSoup& soup, const CertifyOptions& options = {}) {
  return valid_solid(soup, options, nullptr).has_value();
}

// Each triangle with points of its own.
TriangleSoup unwelded(const TriangleSoup& soup) {
  TriangleSoup apart;
  for (const auto& t : soup.triangles) {
    add_triangle(apart, soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
  }
  return apart;
}

RepairOptions keeping_valid() {
  RepairOptions options;
  return options;
}

TEST(ValidSolid, ValidSoupComesOutUnchanged) {
  const TriangleSoup soup = transformed(sphere(300), Eigen::Matrix3d::Identity() / 3);
  const auto kept = valid_solid(soup, {}, nullptr);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->mesh.points, soup.points);
  EXPECT_EQ(kept->mesh.triangles, soup.triangles);
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) EXPECT_EQ(kept->source[t], t);
  EXPECT_EQ(kept->input_point, std::vector<char>(soup.points.size(), 1));
}

TEST(ValidSolid, MayHaveCavitiesAndSolidsInThem) {
  TriangleSoup soup = box({0, 0, 0}, {9, 9, 9});
  append(soup, flipped(box({1, 1, 1}, {8, 8, 8})));
  EXPECT_TRUE(is_valid(soup));
  append(soup, box({2, 2, 2}, {7, 7, 7}));
  EXPECT_TRUE(is_valid(soup));
}

TEST(ValidSolid, RejectsOpenCrossingAndInsideOutSurfaces) {
  TriangleSoup open = cube();
  open.triangles.pop_back();
  EXPECT_FALSE(is_valid(open));
  EXPECT_FALSE(is_valid(flipped(cube())));
  EXPECT_FALSE(is_valid(two_overlapping_spheres(200)));
  TriangleSoup one_turned = cube();
  std::swap(one_turned.triangles[5][0], one_turned.triangles[5][1]);
  EXPECT_FALSE(is_valid(one_turned));
  TriangleSoup twice = cube();
  append(twice, cube());
  EXPECT_FALSE(is_valid(twice));
  TriangleSoup nested = box({0, 0, 0}, {9, 9, 9});
  append(nested, box({1, 1, 1}, {8, 8, 8}));
  EXPECT_FALSE(is_valid(nested));
  TriangleSoup face_to_face = cube();
  append(face_to_face, moved(cube(), {1, 0, 0}));
  EXPECT_FALSE(is_valid(face_to_face));
  EXPECT_FALSE(is_valid({}));
}

TEST(ValidSolid, HostileNumbersAreInvalid) {
  TriangleSoup soup = cube();
  soup.triangles[3][1] = 1000;
  EXPECT_FALSE(is_valid(soup));
  EXPECT_THROW((void)repair(soup, keeping_valid()), InputError);
  soup = cube();
  soup.points[2].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_valid(soup));
  soup.points[2].x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_valid(soup));
}

// A triangle without area closes the edges around it.
TEST(ValidSolid, TriangleWithoutAreaIsInvalid) {
  TriangleSoup soup = cube();
  const auto [a, b, c] = soup.triangles[0];
  const auto middle = static_cast<std::uint32_t>(soup.points.size());
  soup.points.emplace_back(0.5 * (soup.points[a] + soup.points[b]));
  soup.triangles[0] = {a, middle, c};
  soup.triangles.push_back({middle, b, c});
  soup.triangles.push_back({a, b, middle});
  EXPECT_FALSE(is_valid(soup));
}

TEST(ValidSolid, JoinsEqualPointsAndDropsUnusedOnes) {
  TriangleSoup soup = unwelded(sphere(300));
  soup.points.insert(soup.points.begin(), Vec3d(7, 7, 7));
  for (auto& t : soup.triangles) {
    for (std::uint32_t& p : t) ++p;
  }
  const auto kept = valid_solid(soup, {}, nullptr);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->mesh.points.size(), sphere(300).points.size());
  ASSERT_EQ(kept->mesh.triangles.size(), soup.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(kept->mesh.points[kept->mesh.triangles[t][k]], soup.points[soup.triangles[t][k]]);
    }
  }
}

TEST(ValidSolid, MayTouchInAPointWhereTheFormatKeepsPointsApart) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {1, 1, 1}));
  const auto kept = valid_solid(soup, {}, nullptr);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->mesh.points.size(), 16u);
  EXPECT_FALSE(is_valid(soup, welded()));
  EXPECT_FALSE(is_valid(unwelded(soup)));
}

TEST(ValidSolid, TouchesAlongEdgesAsAskedFor) {
  CertifyOptions join;
  join.touching = Touching::join;
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {1, 1, 0}));
  EXPECT_TRUE(is_valid(soup));
  EXPECT_FALSE(is_valid(soup, welded()));
  EXPECT_FALSE(is_valid(soup, join));
  RepairOptions options = keeping_valid();
  options.extract.touching = Touching::join;
  const TriangleSoup joined = repair(soup, options).surface.mesh;
  EXPECT_FALSE(is_valid(joined));
  EXPECT_TRUE(is_valid(joined, join));
  EXPECT_TRUE(is_valid(cube(), join));
}

// Three tetrahedra that touch along edges and are sewn together there, one of them inside out: one
// surface, with two triangles at each of its edges, of positive volume. Its sheets cross along
// edges with one end in common.
TriangleSoup inside_out_in_a_place() {
  TriangleSoup soup;
  soup.points = {{1, 1, 1}, {1, 0, 1}, {1, 0, 0}, {2, 1, 1},
                 {1, 1, 2}, {2, 2, 2}, {1, 1, 1}, {2, 1, 2}};
  soup.triangles = {{1, 0, 7}, {2, 0, 1}, {1, 6, 3}, {1, 7, 4}, {6, 7, 5}, {1, 4, 6},
                    {3, 5, 7}, {6, 5, 3}, {2, 1, 3}, {6, 4, 7}, {2, 3, 0}, {0, 3, 7}};
  return soup;
}

TEST(ValidSolid, PlacesInsideOutAreInvalid) {
  const TriangleSoup soup = inside_out_in_a_place();
  EXPECT_FALSE(is_valid(soup));
  const SurfaceCheck check = check_surface(soup);
  EXPECT_GT(check[Defect::self_intersection].count, 0u);
  EXPECT_FALSE(check.valid_solid());
  const RepairResult result = repair(soup, keeping_valid());
  EXPECT_FALSE(result.report.kept_valid);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_NEAR(result.report.output_volume, 0.5, 1e-9);
}

TEST(ValidSolid, CoordinatesAreTestedAsWritten) {
  TriangleSoup soup = cube();
  soup.points[0] -= Vec3d::Constant(1e-12);
  const auto kept = valid_solid(soup, single_precision(), nullptr);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->mesh.points[0], rounded_to_float32(soup.points[0]));
  EXPECT_EQ(kept->input_point[0], 0);
  TriangleSoup two = cube();
  append(two, moved(cube(), {1 + 1e-12, 0, 0}));
  EXPECT_TRUE(is_valid(two));
  EXPECT_FALSE(is_valid(two, single_precision()));
}

TEST(ValidSolid, ReportIsThatOfARepair) {
  const TriangleSoup soup = sphere(300);
  const RepairResult result = repair(soup, keeping_valid());
  EXPECT_TRUE(result.report.kept_valid);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_EQ(result.report.clean.triangles_in, soup.triangles.size());
  EXPECT_EQ(result.report.triangles.untouched, soup.triangles.size());
  EXPECT_EQ(result.report.triangles.cut, 0u);
  EXPECT_EQ(result.report.output.parts, 1u);
  RepairOptions by_cells;
  by_cells.all_cells = true;
  const RepairResult whole = repair(soup, by_cells);
  EXPECT_FALSE(whole.report.kept_valid);
  EXPECT_DOUBLE_EQ(result.report.output_volume, whole.report.output_volume);
  EXPECT_DOUBLE_EQ(result.report.input_area, whole.report.input_area);
}

TEST(ValidSolid, OptionsThatAskForMoreTakeAnotherWay) {
  TriangleSoup hollow = box({0, 0, 0}, {9, 9, 9});
  append(hollow, flipped(box({1, 1, 1}, {8, 8, 8})));
  RepairOptions options = keeping_valid();
  EXPECT_EQ(repair(hollow, options).report.output.parts, 2u);
  options.inside.rule = InsideRule::solidity;
  EXPECT_EQ(repair(hollow, options).report.output.parts, 1u);
  options = keeping_valid();
  options.check_cells = true;
  EXPECT_FALSE(repair(hollow, options).report.kept_valid);
}

TEST(ValidSolid, StaysBitForBitWhereItsVoidsAreFilled) {
  TriangleSoup nested = box({0, 0, 0}, {9, 9, 9});
  append(nested, flipped(box({1, 1, 1}, {8, 8, 8})));
  append(nested, box({2, 2, 2}, {7, 7, 7}));
  append(nested, box({20, 0, 0}, {21, 1, 1}));
  TriangleSoup outer = box({0, 0, 0}, {9, 9, 9});
  append(outer, box({20, 0, 0}, {21, 1, 1}));
  RepairOptions options = keeping_valid();
  options.inside.cavities = Cavities::fill;
  const RepairResult result = repair(nested, options);
  EXPECT_TRUE(result.report.spared_cells);
  EXPECT_EQ(result.report.inside.filled_voids, 1u);
  EXPECT_EQ(result.surface.mesh.points, outer.points);
  EXPECT_EQ(result.surface.mesh.triangles, outer.triangles);
  EXPECT_TRUE(repair(outer, options).report.kept_valid);
}

// A void whose wall hangs together with what is around it, as solids that touch along an edge are
// separate, is no part of its own.
TEST(ValidSolid, VoidsThatTouchTheOutsideAreFilledToo) {
  TriangleSoup soup = box({0, 0, 0}, {4, 4, 4});
  const Vec3d a(1, 2, 4), b(3, 2, 4), c(2, 1, 2), d(2, 3, 2);
  for (const auto& [p, q, r] : {std::array{a, b, c}, {b, a, d}, {c, d, a}, {d, c, b}}) {
    add_triangle(soup, p, q, r);
  }
  for (const Touching touching : {Touching::separate, Touching::join}) {
    RepairOptions options = keeping_valid();
    options.extract.touching = touching;
    const RepairResult hollow = repair(soup, options);
    EXPECT_LT(hollow.report.output_volume, 63);
    EXPECT_TRUE(repair(hollow.surface.mesh, options).report.kept_valid);
    options.inside.cavities = Cavities::fill;
    EXPECT_NEAR(repair(hollow.surface.mesh, options).report.output_volume, 64, 1e-6);
    EXPECT_NEAR(repair(soup, options).report.output_volume, 64, 1e-6);
  }
}

// What a repair gives needs none, and comes out of a second one as it is.
TEST(ValidSolid, ResultsOfRepairsAreValid) {
  std::size_t kept = 0;
  for (const SoupFamily& family : degenerate_families()) {
    for (std::uint64_t seed = 1; seed <= share_of_cases(12u); ++seed) {
      RepairResult once;
      try {
        once = repair(family.make(seed));
      } catch (const NoSolidError&) {
        continue;
      }
      ASSERT_TRUE(once.report.certify.passed()) << family.name << seed;
      const RepairResult twice = repair(once.surface.mesh, keeping_valid());
      EXPECT_TRUE(twice.report.kept_valid) << family.name << seed;
      EXPECT_EQ(twice.surface.mesh.triangles, once.surface.mesh.triangles) << family.name << seed;
      EXPECT_EQ(twice.surface.mesh.points, once.surface.mesh.points) << family.name << seed;
      ++kept;
    }
  }
  EXPECT_GT(kept, expected_cases(80u));
}

}  // namespace
}  // namespace meshrepair
