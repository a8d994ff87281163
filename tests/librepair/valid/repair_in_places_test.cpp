// SPDX-License-Identifier: MIT
// Large meshes that are solids but for a few places: what comes out is certified, and changed there
// alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/parallel.h>
#include <check/check_surface.h>
#include <mesh/edge_table.h>
#include <mesh/precision.h>
#include <repair/repair.h>

#include "each_seed.h"
#include "shapes.h"
#include "valid/capped_places.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr std::uint32_t kAround = 200, kAcross = 60;  // 24,000 triangles
constexpr std::uint32_t kPlaces = 12;

// A torus in single precision, some of whose corners were moved by so many edges.
struct Planted {
  TriangleSoup soup;
  std::vector<std::uint32_t> moved;
};

Planted with_folds(std::uint64_t seed, double edges = 3) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<> share(-1, 1);
  Planted planted{torus(kAround, kAcross), {}};
  for (std::uint32_t i = 0; i < kPlaces; ++i) {
    const auto p = static_cast<std::uint32_t>(random() % planted.soup.points.size());
    planted.moved.push_back(p);
    const Vec3d way(share(random), share(random), share(random));
    planted.soup.points[p] += 0.08 * edges * way.normalized();
  }
  for (Vec3d& p : planted.soup.points) p = rounded_to_float32(p);
  return planted;
}

RepairOptions for_binary_stl() {
  RepairOptions options;
  options.certify.precision = Precision::float32;
  options.certify.welded = true;
  return options;
}

// Whether places were repaired, and put back after that, and not the whole.
bool is_of_places(const RepairReport& report) {
  const std::size_t count = report.stages.size();
  return count > 1 && report.stages[count - 2].name == "places";
}

void expect_whole_elsewhere(const Planted& planted, const RepairResult& result) {
  std::vector<char> may_change(planted.soup.triangles.size(), 0);
  for (std::size_t t = 0; t < may_change.size(); ++t) {
    for (const std::uint32_t p : planted.soup.triangles[t]) {
      for (const std::uint32_t q : planted.moved) {
        const double away = (planted.soup.points[p] - planted.soup.points[q]).norm();
        if (away < 1) may_change[t] = 1;
      }
    }
  }
  std::vector<std::size_t> seen(may_change.size(), 0);
  for (std::size_t t = 0; t < result.surface.source.size(); ++t) {
    const std::uint32_t source = result.surface.source[t];
    if (source == Surface::kNoSource) continue;
    ++seen[source];
    if (may_change[source] != 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& p = result.surface.mesh.points[result.surface.mesh.triangles[t][k]];
      EXPECT_EQ(p, planted.soup.points[planted.soup.triangles[source][k]]);
    }
  }
  for (std::size_t t = 0; t < seen.size(); ++t) {
    if (may_change[t] == 0) {
      EXPECT_EQ(seen[t], 1u) << t;
    }
  }
}

TEST(RepairOfPlaces, AreRepairedAlone) {
  std::size_t of_places = 0, all = 0;
  for_each_seed(1, 12, [&](std::uint64_t seed) {
    const Planted planted = with_folds(seed);
    for (const RepairOptions& options : {for_binary_stl(), RepairOptions()}) {
      const RepairResult result = repair(planted.soup, options);
      EXPECT_TRUE(result.report.certify.passed()) << seed;
      EXPECT_TRUE(check_surface(result.surface.mesh, {}).valid_solid()) << seed;
      EXPECT_EQ(result.report.inside.used, InsideRule::winding);
      if (result.report.kept_valid) continue;
      ++all;
      if (!is_of_places(result.report)) continue;
      ++of_places;
      expect_whole_elsewhere(planted, result);
      EXPECT_EQ(result.report.triangles.untouched + result.report.triangles.cut,
                result.report.parts.bounding_triangles);
      EXPECT_EQ(result.report.parts.bounding_triangles + result.report.parts.inside_triangles +
                    result.report.parts.outside_triangles,
                planted.soup.triangles.size());
    }
  });
  EXPECT_GE(10 * of_places, 9 * all);
}

// With a body beside it that is not closed as given, the whole is repaired: the result is the same
// but for the last bits, and that body.
TEST(RepairOfPlaces, GiveTheSolidOfTheWholeWork) {
  for_each_seed(1, 20, [&](std::uint64_t seed) {
    const Planted planted = with_folds(seed);
    const RepairResult places = repair(planted.soup, for_binary_stl());
    TriangleSoup more = planted.soup;
    append(more, box({4, 4, 0}, {4.5, 4.5, 0.5}));
    more.triangles.push_back(more.triangles.back());
    const RepairResult whole = repair(more, for_binary_stl());
    EXPECT_TRUE(whole.report.certify.passed());
    EXPECT_FALSE(is_of_places(whole.report));
    EXPECT_NEAR(places.report.output_volume + 0.125, whole.report.output_volume, 1e-6);
    EXPECT_EQ(places.report.output.parts + 1, whole.report.output.parts);
    EXPECT_EQ(places.report.inside.left_out_folds, whole.report.inside.left_out_folds);
  });
}

TEST(RepairOfPlaces, DependNotOnThreadsOrScale) {
  const Planted planted = with_folds(3);
  const RepairResult result = repair(planted.soup, for_binary_stl());
  ASSERT_TRUE(is_of_places(result.report));
  const ThreadLimit limit(1);
  const RepairResult alone = repair(planted.soup, for_binary_stl());
  EXPECT_EQ(alone.surface.mesh.triangles, result.surface.mesh.triangles);
  EXPECT_EQ(alone.surface.mesh.points, result.surface.mesh.points);
  const RepairResult larger = repair(scaled(planted.soup, 64), for_binary_stl());
  EXPECT_EQ(larger.surface.mesh.triangles, result.surface.mesh.triangles);
  EXPECT_EQ(larger.surface.mesh.points, scaled(result.surface.mesh, 64).points);
}

// Of corners in double precision that the file rounds, the same triangles are cut.
TEST(RepairOfPlaces, TellWhatWasRoundedFromWhatWasCut) {
  for_each_seed(1, 4, [&](std::uint64_t seed) {
    Planted planted = with_folds(seed);
    const RepairResult given_rounded = repair(planted.soup, for_binary_stl());
    for (Vec3d& p : planted.soup.points) p *= 1 + 0x1p-40;
    const RepairResult rounded = repair(planted.soup, for_binary_stl());
    if (given_rounded.report.kept_valid) return;
    ASSERT_TRUE(is_of_places(rounded.report));
    const TriangleFates& fates = rounded.report.triangles;
    EXPECT_EQ(fates.cut - fates.rounded, given_rounded.report.triangles.cut);
    EXPECT_EQ(fates.untouched + fates.rounded, given_rounded.report.triangles.untouched);
  });
}

TEST(RepairOfPlaces, AreNotWherePartsLieInParts) {
  TriangleSoup soup = sphere(24'000, 3);
  soup.points[5000] = soup.points[5004];
  soup.points[5000] *= 1.01;
  TriangleSoup hollow = sphere(2000);
  for (auto& t : hollow.triangles) std::swap(t[1], t[2]);
  append(soup, hollow);
  const RepairResult result = repair(soup);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_FALSE(result.report.kept_valid);
  EXPECT_FALSE(is_of_places(result.report));
}

TEST(RepairOfPlaces, AreNotWhereBodiesCross) {
  const RepairResult result = repair(two_overlapping_spheres(40'000));
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_FALSE(is_of_places(result.report));
}

TEST(CappedPlaces, AreClosedBodies) {
  for_each_seed(1, 20, [&](std::uint64_t seed) {
    const Planted planted = with_folds(seed, 0);
    std::vector<std::uint32_t> seeds;
    for (std::uint32_t t = 0; t < planted.soup.triangles.size(); ++t) {
      for (const std::uint32_t p : planted.soup.triangles[t]) {
        if (std::find(planted.moved.begin(), planted.moved.end(), p) != planted.moved.end()) {
          seeds.push_back(t);
        }
      }
    }
    const auto places =
        internal::cap_places(planted.soup, seeds, 12'000, Precision::float64, nullptr);
    ASSERT_TRUE(places) << seed;
    const SurfaceCheck check = check_surface(places->soup, {});
    EXPECT_TRUE(check.valid_solid()) << seed;
    EXPECT_LE(check.parts.size(), kPlaces);
    EXPECT_LT(places->triangle.size(), 100 * kPlaces);
    for (std::size_t t = 0; t < places->triangle.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(places->point[places->soup.triangles[t][k]],
                  planted.soup.triangles[places->triangle[t]][k]);
      }
    }
  });
}

TEST(CappedPlaces, AreNoneWhereTheyWouldHaveTooMany) {
  const Planted planted = with_folds(1, 0);
  const std::vector<std::uint32_t> seeds = {0, 5000};
  EXPECT_TRUE(internal::cap_places(planted.soup, seeds, 200, Precision::float64, nullptr));
  EXPECT_FALSE(internal::cap_places(planted.soup, seeds, 20, Precision::float64, nullptr));
}

}  // namespace
}  // namespace meshrepair
