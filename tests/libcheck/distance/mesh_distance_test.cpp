// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/parallel.h>
#include <check/internal/nearest_triangle.h>
#include <check/mesh_distance.h>

#include "shapes.h"

namespace meshrepair {
namespace {

TriangleSoup square(double height, double size = 1) {
  return {{{0, 0, height}, {size, 0, height}, {size, size, height}, {0, size, height}},
          {{{0, 1, 2}}, {{0, 2, 3}}}};
}

DistanceOptions with_bound(std::size_t samples = 20000) {
  DistanceOptions options;
  options.samples = samples;
  options.bound = true;
  return options;
}

TEST(MeshDistance, OfParallelSquaresIsTheirHeight) {
  const MeshDistance d = mesh_distance(square(0), square(0.25), with_bound());
  for (const OneSidedDistance& way : {d.forth, d.back}) {
    EXPECT_NEAR(way.mean, 0.25, 1e-12);
    EXPECT_NEAR(way.rms, 0.25, 1e-12);
    EXPECT_NEAR(way.largest, 0.25, 1e-12);
    EXPECT_GE(*way.bound, way.largest);
    EXPECT_NEAR(*way.bound, 0.25, 1e-12);
    EXPECT_EQ(way.samples, 20000u);
  }
  EXPECT_NEAR(d.diagonal, std::sqrt(2), 1e-15);
}

TEST(MeshDistance, OfEqualMeshesIsNothing) {
  const TriangleSoup soup = testing::sphere(3000);
  const MeshDistance d = mesh_distance(soup, soup, with_bound());
  EXPECT_LT(d.largest(), 1e-15);
  EXPECT_LT(*d.bound(), 1e-12);
}

// The far part of the larger square is only seen from the larger.
TEST(MeshDistance, IsOneSidedEachWay) {
  const MeshDistance d = mesh_distance(square(0, 1), square(0, 3), with_bound());
  EXPECT_LT(d.forth.largest, 1e-15);
  EXPECT_NEAR(d.back.largest, 2 * std::sqrt(2), 1e-12);
  EXPECT_LE(*d.back.bound, 1.1 * 2 * std::sqrt(2) + 1e-9);
  EXPECT_GE(*d.back.bound, 2 * std::sqrt(2));
  EXPECT_EQ(d.back.at, Vec3d(3, 3, 0));
  EXPECT_EQ(d.largest(), d.back.largest);
  // Integrated: two strips of 1 x 2 with distances 0 to 2, and a square of side 2 by its corner.
  const double by_corner = 8 * (std::sqrt(2) + std::asinh(1)) / 3;
  EXPECT_NEAR(d.back.mean, (2 * 2 + by_corner) / 9, 0.01);
}

TEST(MeshDistance, OfConcentricSpheresIsTheGap) {
  const TriangleSoup inner = testing::sphere(20000), outer = testing::scaled(inner, 1.1);
  const MeshDistance d = mesh_distance(inner, outer, with_bound());
  EXPECT_NEAR(d.forth.mean, 0.1, 1e-3);
  EXPECT_NEAR(d.back.mean, 0.1, 1e-3);
  EXPECT_NEAR(d.largest(), 0.1, 1e-3);
  EXPECT_LE(*d.bound(), 1.1 * d.largest() + 1e-9);
}

TEST(MeshDistance, BoundFindsWhatFewSamplesMiss) {
  // The middle of a long edge is far from the other mesh, its ends are not.
  const TriangleSoup wide = {{{0, 0, 0}, {100, 0, 0}, {0, 0.01, 0}}, {{{0, 1, 2}}}};
  TriangleSoup ends = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {100, 0, 0}, {99, 0, 0}, {100, 1, 0}},
                       {{{0, 1, 2}}, {{3, 4, 5}}}};
  const MeshDistance d = mesh_distance(wide, ends, with_bound(1));
  EXPECT_GE(*d.forth.bound, 49);
  EXPECT_LE(*d.forth.bound, 1.1 * 49.5);
}

// A square that is cut into strips across each other.
TEST(MeshDistance, BoundIsTightForOtherTrianglesOfTheSameSurface) {
  const auto grid = [](int columns, int rows) {
    TriangleSoup soup;
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        TriangleSoup part = square(0);
        for (Vec3d& p : part.points) {
          p = Vec3d((i + p.x()) / columns, (j + p.y()) / rows, 0);
          p.z() = 0.3 * p.x() + 0.7 * p.y();
        }
        testing::append(soup, part);
      }
    }
    return soup;
  };
  const MeshDistance d = mesh_distance(grid(1, 11), grid(7, 3), with_bound());
  EXPECT_LT(*d.bound(), 1e-7);
}

TEST(MeshDistance, BoundHoldsForEverySample) {
  const TriangleSoup a = testing::noisy_sphere(2000, 0.05, 1), b = testing::sphere(1500);
  DistanceOptions fine;
  fine.samples = 300000;
  const MeshDistance sampled = mesh_distance(a, b, fine);
  for (const double factor : {1.01, 1.1, 2.0}) {
    DistanceOptions coarse = with_bound(100);
    coarse.bound_factor = factor;
    const MeshDistance d = mesh_distance(a, b, coarse);
    EXPECT_GE(*d.forth.bound, sampled.forth.largest);
    EXPECT_GE(*d.back.bound, sampled.back.largest);
    EXPECT_LE(*d.bound(), factor * std::max(d.largest(), sampled.largest()) * 1.02);
  }
}

TEST(MeshDistance, BoundHoldsHoweverLittleWorkIsAllowed) {
  const TriangleSoup a = testing::noisy_sphere(2000, 0.05, 1), b = testing::sphere(1500);
  const MeshDistance sampled = mesh_distance(a, b);
  double last = std::numeric_limits<double>::infinity();
  for (const std::size_t pieces : {0u, 5000u, 100000u}) {
    DistanceOptions options = with_bound();
    options.most_pieces = pieces;
    options.bound_factor = 1.001;
    const double bound = *mesh_distance(a, b, options).bound();
    EXPECT_GE(bound, sampled.largest());
    EXPECT_LE(bound, last);
    last = bound;
  }
}

TEST(TrianglesBeyond, AreThoseThatSamplesFind) {
  const TriangleSoup a = testing::noisy_sphere(2000, 0.05, 1), b = testing::sphere(1500);
  DistanceOptions fine;
  fine.samples = 300000;
  const double largest = mesh_distance(a, b, fine).forth.largest;
  EXPECT_TRUE(triangles_beyond(a, b, 1.05 * largest).empty());
  EXPECT_FALSE(triangles_beyond(a, b, 0.95 * largest).empty());
  const std::vector<std::uint32_t> far = triangles_beyond(a, b, 0.5 * largest);
  for (std::uint32_t t = 0; t < a.triangles.size(); ++t) {
    if (std::binary_search(far.begin(), far.end(), t)) continue;
    TriangleSoup one{a.points, {a.triangles[t]}};
    EXPECT_LE(one_sided_distance(one, b, with_bound(100)).largest, 0.5 * largest);
  }
}

TEST(TrianglesBeyond, KnowTheSameSurfaceInOtherTriangles) {
  const TriangleSoup one = square(0);
  TriangleSoup other = square(0);
  other.triangles = {{{0, 1, 3}}, {{1, 2, 3}}};
  EXPECT_TRUE(triangles_beyond(one, other, 1e-9).empty());
  EXPECT_EQ(triangles_beyond(one, square(0.5), 0.49).size(), 2u);
  EXPECT_TRUE(triangles_beyond(one, square(0.5), 0.51).empty());
}

TEST(MeshDistance, SeedAndThreadsDecideEverything) {
  const TriangleSoup a = testing::noisy_sphere(3000, 0.05, 1), b = testing::sphere(3000);
  DistanceOptions options = with_bound(30000);
  const MeshDistance parallel = mesh_distance(a, b, options);
  {
    const ThreadLimit one(1);
    const MeshDistance serial = mesh_distance(a, b, options);
    EXPECT_EQ(parallel.forth.mean, serial.forth.mean);
    EXPECT_EQ(parallel.back.rms, serial.back.rms);
    EXPECT_EQ(parallel.forth.at, serial.forth.at);
    EXPECT_EQ(parallel.bound(), serial.bound());
  }
  options.seed = 2;
  EXPECT_NE(mesh_distance(a, b, options).forth.mean, parallel.forth.mean);
}

TriangleSoup times_two_to(TriangleSoup soup, int exponent) {
  for (Vec3d& p : soup.points) p = p.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
  return soup;
}

void expect_scaled(const OneSidedDistance& way, const OneSidedDistance& plain, int exponent) {
  const auto scaled = [&](double x) { return std::ldexp(x, exponent); };
  EXPECT_EQ(way.samples, plain.samples);
  EXPECT_EQ(way.mean, scaled(plain.mean));
  EXPECT_EQ(way.rms, scaled(plain.rms));
  EXPECT_EQ(way.largest, scaled(plain.largest));
  EXPECT_EQ(way.at, plain.at.unaryExpr(scaled));
  EXPECT_EQ(way.bound, plain.bound ? std::optional(scaled(*plain.bound)) : std::nullopt);
}

// Whatever the unit: squares and products of such lengths are beyond doubles.
TEST(MeshDistance, TimesAPowerOfTwoIsExactlyThat) {
  const TriangleSoup a = testing::noisy_sphere(500, 0.05, 1);
  const TriangleSoup b = testing::moved(testing::sphere(300), {0.5, 0, 0});
  const MeshDistance plain = mesh_distance(a, b, with_bound(2000));
  EXPECT_GT(plain.largest(), 0.4);
  for (const int exponent : {-900, -600, -300, -30, 30, 300, 500, 900}) {
    SCOPED_TRACE(exponent);
    const TriangleSoup large = times_two_to(a, exponent), other = times_two_to(b, exponent);
    const MeshDistance d = mesh_distance(large, other, with_bound(2000));
    expect_scaled(d.forth, plain.forth, exponent);
    expect_scaled(d.back, plain.back, exponent);
    EXPECT_EQ(d.diagonal, std::ldexp(plain.diagonal, exponent));
    EXPECT_EQ(bounding_diagonal(large), d.diagonal);
    expect_scaled(one_sided_distance(large, other), one_sided_distance(a, b), exponent);
  }
}

TEST(MeshDistance, FarSmallerMeshHasTheRightDistance) {
  const MeshDistance d =
      mesh_distance(times_two_to(square(0), -600), square(0.25), with_bound(100));
  EXPECT_EQ(d.forth.samples, 100u);
  EXPECT_EQ(d.forth.mean, 0.25);
  EXPECT_EQ(d.diagonal, std::ldexp(bounding_diagonal(square(0)), -600));
}

TEST(MeshDistance, DistanceBeyondDoublesIsInfinite) {
  const TriangleSoup low = {{{-1e308, 0, 0}, {-1e308, 1e308, 0}, {-1e308, 0, 1e308}},
                            {{{0, 1, 2}}}};
  const TriangleSoup high = testing::moved(low, {1e308, 0, 0});
  EXPECT_DOUBLE_EQ(mesh_distance(low, high).largest(), 1e308);
  EXPECT_EQ(mesh_distance(low, testing::moved(high, {1e308, 0, 0})).largest(),
            std::numeric_limits<double>::infinity());
}

TEST(MeshDistance, LeavesOutWhatIsNotFiniteAndTakesWhatHasNoArea) {
  TriangleSoup soup = square(0);
  soup.points.emplace_back(0, 0, std::numeric_limits<double>::infinity());
  soup.triangles.push_back({0, 1, 4});
  EXPECT_EQ(mesh_distance(soup, square(0)).not_finite, 1u);
  const TriangleSoup point = {{{0, 0, 2}}, {{{0, 0, 0}}}};
  const MeshDistance d = mesh_distance(point, square(0), with_bound(100));
  EXPECT_EQ(d.forth.samples, 0u);
  EXPECT_EQ(d.forth.largest, 2);
  EXPECT_NEAR(*d.forth.bound, 2, 1e-12);
  EXPECT_NEAR(d.back.largest, std::sqrt(6), 1e-12);
}

TEST(MeshDistance, NeedsMeshesAndSensibleOptions) {
  EXPECT_THROW(static_cast<void>(mesh_distance({}, square(0))), InputError);
  DistanceOptions options;
  options.samples = 0;
  EXPECT_THROW(static_cast<void>(mesh_distance(square(0), square(0), options)), UsageError);
  options.samples = 1;
  options.bound_factor = 1;
  EXPECT_THROW(static_cast<void>(mesh_distance(square(0), square(0), options)), UsageError);
}

TEST(NearestTriangle, AgreesWithTryingAll) {
  const TriangleSoup soup = testing::random_soup(300, 20, 1);
  std::vector<internal::Corners> triangles;
  for (const auto& t : soup.triangles) {
    triangles.push_back({soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]});
  }
  const internal::NearestTriangle nearest(triangles);
  testing::Random random(2);
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const Vec3d p(random.real(-5, 25), random.real(-5, 25), random.real(-5, 25));
    double best = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles) best = std::min(best, internal::squared_distance(p, t));
    const internal::Nearest found = nearest.find(p, i % 300);
    EXPECT_DOUBLE_EQ(found.squared_distance, best);
  }
}

TEST(SquaredDistance, DistancesToInsideSidesAndCornersAreExact) {
  const internal::Corners t = {Vec3d(0, 0, 0), Vec3d(4, 0, 0), Vec3d(0, 4, 0)};
  EXPECT_DOUBLE_EQ(internal::squared_distance({1, 1, 3}, t), 9);
  EXPECT_DOUBLE_EQ(internal::squared_distance({2, -3, 4}, t), 25);
  EXPECT_DOUBLE_EQ(internal::squared_distance({-3, -4, 0}, t), 25);
  EXPECT_DOUBLE_EQ(internal::squared_distance({4, 4, 1}, t), 9);
  EXPECT_DOUBLE_EQ(internal::squared_distance({7, 4, 0}, {Vec3d(0, 0, 0), {4, 0, 0}, {2, 0, 0}}),
                   25);
}

TEST(MeshDistance, OneWayAloneGivesThatDistance) {
  const TriangleSoup a = testing::sphere(500);
  const TriangleSoup b = testing::moved(testing::sphere(300, 1.1), {0.1, 0, 0});
  const MeshDistance both = mesh_distance(a, b);
  const OneSidedDistance forth = one_sided_distance(a, b);
  EXPECT_EQ(forth.mean, both.forth.mean);
  EXPECT_EQ(forth.largest, both.forth.largest);
  EXPECT_EQ(one_sided_distance(b, a).largest, both.back.largest);
  EXPECT_EQ(bounding_diagonal(a), both.diagonal);
}

}  // namespace
}  // namespace meshrepair
