// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/parallel.h>
#include <check/mesh_distance.h>
#include <mesh/topology.h>
#include <points/point_soup.h>
#include <repair/keep_parts.h>
#include <repair/repair.h>

#include "point_clouds.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using testing::genus_of;
using testing::sampled_at_random;
using testing::sampled_evenly;
using testing::spacing_of;
using testing::with_noise;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PointSoup soup_of(const PointCloud& cloud, const PointSoupOptions& options = {}) {
  PointSoupReport report;
  return make_point_soup(cloud, options, report);
}

struct Sampling {
  const char* name;
  bool random;
  double noise;
};

class SolidFromPoints : public ::testing::TestWithParam<Sampling> {
 public:
  // A certified solid of that many handles and parts, nowhere farther than two spacings from the
  // truth, nor the truth from it.
  static void expect_found_again(const TriangleSoup& solid, std::int64_t genus, std::size_t parts) {
    constexpr std::size_t kPoints = 2000;
    const Sampling& sampling = GetParam();
    const double spacing = spacing_of(solid, kPoints);
    PointCloud cloud =
        sampling.random ? sampled_at_random(solid, kPoints, 1) : sampled_evenly(solid, kPoints, 1);
    cloud = with_noise(std::move(cloud), sampling.noise * spacing, 2);
    RepairResult result = repair(soup_of(cloud).soup);
    (void)drop_small_parts(result.surface, PointSoupOptions().fewest_triangles, result.report);
    const Topology& output = result.report.output;
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_TRUE(output.closed() && output.manifold() && output.oriented());
    EXPECT_EQ(output.parts, parts);
    EXPECT_EQ(genus_of(output, result.surface.mesh.points.size()), genus);
    EXPECT_LE(mesh_distance(result.surface.mesh, solid).largest(), 2 * spacing);
  }
};

TEST_P(SolidFromPoints, SphereIsReconstructed) { expect_found_again(testing::sphere(20000), 0, 1); }

TEST_P(SolidFromPoints, TorusIsReconstructed) { expect_found_again(testing::torus(150, 50), 1, 1); }

TEST_P(SolidFromPoints, PlateOfThreeSpacingsIsReconstructed) {
  expect_found_again(testing::box({0, 0, 0}, {1, 1, 0.072}), 0, 1);
}

TEST_P(SolidFromPoints, PlatesFourSpacingsApartStayApart) {
  TriangleSoup plates = testing::box({0, 0, 0}, {1, 1, 0.11});
  testing::append(plates, testing::box({0, 0, 0.26}, {1, 1, 0.37}));
  expect_found_again(plates, 0, 2);
}

TEST_P(SolidFromPoints, SurfaceOfGenusFiveIsReconstructed) {
  expect_found_again(testing::genus_five_body(), 5, 1);
}

INSTANTIATE_TEST_SUITE_P(Samplings, SolidFromPoints,
                         ::testing::Values(Sampling{"Even", false, 0},
                                           Sampling{"EvenWithNoise", false, 0.1},
                                           Sampling{"Random", true, 0},
                                           Sampling{"RandomWithNoise", true, 0.1}),
                         [](const auto& tested) { return tested.param.name; });

TEST(PointSoup, OfAGridOnAPlaneHasNoOverlaps) {
  PointCloud cloud;
  for (int x = 0; x < 20; ++x) {
    for (int y = 0; y < 20; ++y) cloud.points.emplace_back(x, y, 0);
  }
  PointSoupReport report;
  const PointSoup soup = make_point_soup(cloud, {}, report);
  EXPECT_EQ(soup.soup.triangles.size(), 2U * 19 * 19);
  EXPECT_EQ(report.disagreed, 0U);
  EXPECT_NEAR(surface_area(soup.soup), 19 * 19, 1e-9);
}

TEST(PointSoup, KeepsCoordinatesBitForBit) {
  const PointCloud cloud = sampled_evenly(testing::sphere(5000), 500, 3);
  EXPECT_EQ(soup_of(cloud).soup.points, cloud.points);
}

TEST(PointSoup, DropsAndCountsWhatIsNotFiniteAndWhatIsThereTwice) {
  PointCloud cloud = sampled_evenly(testing::sphere(5000), 500, 3);
  cloud.points.push_back(cloud.points[7]);
  cloud.points.emplace_back(kNaN, 0, 0);
  cloud.points.emplace_back(0, std::numeric_limits<double>::infinity(), 0);
  PointSoupReport report;
  const PointSoup soup = make_point_soup(cloud, {}, report);
  EXPECT_EQ(report.points_in, 503U);
  EXPECT_EQ(report.duplicates, 1U);
  EXPECT_EQ(report.not_finite, 2U);
  EXPECT_EQ(report.points, 500U);
  EXPECT_EQ(soup.soup.points.size(), 500U);
}

TEST(PointSoup, DropsOutliers) {
  PointCloud cloud = sampled_evenly(testing::sphere(5000), 500, 3);
  cloud.points.emplace_back(0, 0, 4);
  PointSoupReport report;
  EXPECT_EQ(make_point_soup(cloud, {}, report).soup.points.size(), 500U);
  EXPECT_EQ(report.outliers, 1U);
  PointSoupOptions options;
  options.outlier = 0;
  EXPECT_EQ(make_point_soup(cloud, options, report).soup.points.size(), 501U);
}

TEST(PointSoup, NormalsTurnTheTriangles) {
  PointCloud cloud = sampled_evenly(testing::sphere(20000), 1000, 3);
  for (const Vec3d& p : cloud.points) cloud.normals.emplace_back(-3 * p);
  const TriangleSoup inward = soup_of(cloud).soup;
  EXPECT_LT(signed_volume(inward), -4);
  for (Vec3d& n : cloud.normals) n = -n;
  const TriangleSoup outward = soup_of(cloud).soup;
  EXPECT_EQ(examine_topology(outward.triangles, outward.points.size()).inconsistent_edges, 0U);
  EXPECT_GT(signed_volume(outward), 4);
}

TEST(PointSoup, NormalsWithoutLengthAreFitted) {
  PointCloud cloud = sampled_evenly(testing::sphere(20000), 1000, 3);
  const std::size_t triangles = soup_of(cloud).soup.triangles.size();
  cloud.normals.assign(cloud.points.size(), Vec3d(0, 0, 0));
  EXPECT_EQ(soup_of(cloud).soup.triangles.size(), triangles);
}

TEST(PointSoup, IsTheSameForAnyNumberOfThreads) {
  const PointCloud cloud = with_noise(sampled_at_random(testing::torus(150, 50), 5000, 1), 0.01, 2);
  PointSoupOptions options;
  options.project = 1;
  std::vector<PointSoup> results;
  for (const std::size_t threads : {std::size_t{1}, std::size_t{4}}) {
    const ThreadLimit limit(threads);
    results.push_back(soup_of(cloud, options));
  }
  EXPECT_EQ(results[0].soup.points, results[1].soup.points);
  EXPECT_EQ(results[0].soup.triangles, results[1].soup.triangles);
  EXPECT_EQ(results[0].votes, results[1].votes);
}

TEST(PointSoup, ScaleAndPlaceDoNotMatter) {
  const PointCloud cloud = sampled_at_random(testing::torus(150, 50), 1000, 1);
  const auto triangles = soup_of(cloud).soup.triangles;
  for (const double scale : {0x1p-400, 0x1p400}) {
    PointCloud scaled = cloud;
    for (Vec3d& p : scaled.points) p *= scale;
    EXPECT_EQ(soup_of(scaled).soup.triangles, triangles);
  }
}

TEST(PointSoup, MoreVotesAreFewerTriangles) {
  const PointCloud cloud = with_noise(sampled_at_random(testing::sphere(20000), 2000, 1), 0.02, 2);
  std::size_t before = std::numeric_limits<std::size_t>::max();
  for (const int votes : {1, 2, 3}) {
    PointSoupOptions options;
    options.votes = votes;
    const PointSoup soup = soup_of(cloud, options);
    EXPECT_LT(soup.soup.triangles.size(), before);
    before = soup.soup.triangles.size();
    for (const std::uint8_t v : soup.votes) EXPECT_GE(v, votes);
  }
}

TEST(PointSoup, ProjectionTakesNoiseAway) {
  const TriangleSoup sphere = testing::sphere(50000);
  const PointCloud noisy = with_noise(sampled_evenly(sphere, 2000, 1), 0.03, 2);
  const auto rms = [](const std::vector<Vec3d>& points) {
    double sum = 0;
    for (const Vec3d& p : points) sum += (p.norm() - 1) * (p.norm() - 1);
    return std::sqrt(sum / static_cast<double>(points.size()));
  };
  PointSoupOptions options;
  options.project = 2;
  PointSoupReport report;
  const PointSoup soup = make_point_soup(noisy, options, report);
  EXPECT_LT(rms(soup.soup.points), 0.5 * rms(noisy.points));
  EXPECT_GT(report.farthest_move, 0);
  EXPECT_EQ(report.points, soup.soup.points.size());
}

TEST(PointSoup, OfTooFewPointsIsNoSolid) {
  PointCloud cloud;
  EXPECT_THROW((void)soup_of(cloud), NoSolidError);
  cloud.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}};
  EXPECT_THROW((void)soup_of(cloud), NoSolidError);
}

TEST(PointSoup, OfALineIsNoSolid) {
  PointCloud cloud;
  for (int i = 0; i < 100; ++i) cloud.points.emplace_back(i, 2 * i, -i);
  EXPECT_THROW((void)soup_of(cloud), NoSolidError);
}

TEST(PointSoup, RefusesOptionsThatMakeNoSense) {
  const PointCloud cloud = sampled_evenly(testing::sphere(5000), 100, 3);
  PointSoupOptions options;
  options.votes = 4;
  EXPECT_THROW((void)soup_of(cloud, options), UsageError);
  options = {};
  options.reach = kNaN;
  EXPECT_THROW((void)soup_of(cloud, options), UsageError);
  options = {};
  options.neighbours = 2;
  EXPECT_THROW((void)soup_of(cloud, options), UsageError);
}

TEST(PointSoup, CanBeStopped) {
  class Stop : public ProgressObserver {
   public:
    bool cancelled() override { return true; }
  };
  Stop stop;
  PointSoupOptions options;
  options.progress = &stop;
  EXPECT_THROW((void)soup_of(sampled_evenly(testing::sphere(5000), 1000, 3), options), Cancelled);
}

}  // namespace
}  // namespace meshrepair
