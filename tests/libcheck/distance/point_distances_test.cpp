// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <check/mesh_distance.h>
#include <check/point_distances.h>

#include "shapes.h"

namespace meshrepair {
namespace {

TEST(PointDistances, AreThoseToTheNearestPlace) {
  const TriangleSoup box = testing::box({0, 0, 0}, {1, 1, 1});
  const std::vector<Vec3d> points = {
      {0.5, 0.5, 3}, {0.5, 0.5, 0.5}, {1, 1, 1}, {4, 5, 1}, {0.25, 0, 0.5}};
  const std::vector<double> expected = {2, 0.5, 0, 5, 0};
  const std::vector<double> distances = point_distances(points, box);
  ASSERT_EQ(distances.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(distances[i], expected[i], 1e-15);
}

TEST(PointDistances, OfCornersAreNotBeyondTheHausdorffDistance) {
  const TriangleSoup sphere = testing::sphere(3000);
  const TriangleSoup box = testing::box({-1, -1, -1}, {1, 1, 1});
  const double largest = one_sided_distance(box, sphere).largest;
  const std::vector<double> distances = point_distances(box.points, sphere);
  for (const double distance : distances) EXPECT_LE(distance, largest);
  EXPECT_DOUBLE_EQ(*std::max_element(distances.begin(), distances.end()), largest);
}

TEST(PointDistances, AreThoseInAnyUnit) {
  for (const double unit : {0x1p-600, 0x1p-300, 0x1p300, 0x1p500}) {
    const TriangleSoup box = testing::box(Vec3d::Zero(), Vec3d::Constant(unit));
    const std::vector<Vec3d> points = {{0.5 * unit, 0.5 * unit, 3 * unit}};
    EXPECT_EQ(point_distances(points, box), std::vector<double>{2 * unit});
  }
}

TEST(PointDistances, PassOverWhatIsNotFinite) {
  TriangleSoup box = testing::box({0, 0, 0}, {1, 1, 1});
  const std::vector<Vec3d> points = {{0.5, 0.5, 3}};
  box.points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  box.triangles.push_back({0, 1, 8});
  EXPECT_DOUBLE_EQ(point_distances(points, box)[0], 2);
  EXPECT_THROW((void)point_distances(points, {}), InputError);
}

}  // namespace
}  // namespace meshrepair
