// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string_view>

#include <gtest/gtest.h>

#include <base/error.h>
#include <picture/camera.h>
#include <picture/view.h>

#include "shapes.h"

namespace meshrepair {
namespace {

Camera camera_of(const TriangleSoup& soup, std::string_view view, View::Up up = View::Up::z) {
  View from = *view_of(view);
  from.up = up;
  return {from, {200, 100}, {&soup}};
}

// Where the point is, from the middle of the picture: to the right and up.
std::pair<int, int> side_of(const Camera& camera, const Vec3d& point) {
  const Camera::Place place = camera.place(point);
  const auto sign = [](double x) { return x > 1e-6 ? 1 : x < -1e-6 ? -1 : 0; };
  return {sign(place.x - 100), sign(50 - place.y)};
}

TEST(Camera, SeesAxesWhereTheNameOfTheViewSaysSo) {
  const TriangleSoup soup = testing::box({-1, -1, -1}, {1, 1, 1});
  using Side = std::pair<int, int>;
  const struct {
    std::string_view view;
    Side x, y, z;
  } cases[] = {{"front", {1, 0}, {0, 0}, {0, 1}}, {"back", {-1, 0}, {0, 0}, {0, 1}},
               {"right", {0, 0}, {1, 0}, {0, 1}}, {"left", {0, 0}, {-1, 0}, {0, 1}},
               {"top", {1, 0}, {0, 1}, {0, 0}},   {"bottom", {1, 0}, {0, -1}, {0, 0}},
               {"iso", {1, -1}, {1, 1}, {0, 1}}};
  for (const auto& [view, x, y, z] : cases) {
    const Camera camera = camera_of(soup, view);
    EXPECT_EQ(side_of(camera, {1, 0, 0}), x) << view;
    EXPECT_EQ(side_of(camera, {0, 1, 0}), y) << view;
    EXPECT_EQ(side_of(camera, {0, 0, 1}), z) << view;
    const Camera y_up = camera_of(soup, view, View::Up::y);  // (x, y, z) is (x, -z, y) with z up
    EXPECT_EQ(side_of(y_up, {1, 0, 0}), x) << view;
    EXPECT_EQ(side_of(y_up, {0, 0, -1}), y) << view;
    EXPECT_EQ(side_of(y_up, {0, 1, 0}), z) << view;
  }
}

TEST(Camera, WhatIsNearerHasMoreDepth) {
  const TriangleSoup soup = testing::box({-1, -1, -1}, {1, 1, 1});
  EXPECT_GT(camera_of(soup, "front").place({0, -1, 0}).depth,
            camera_of(soup, "front").place({0, 1, 0}).depth);
  EXPECT_GT(camera_of(soup, "top").place({0, 0, 1}).depth, 0.7);
}

// All within, and nearly as far as the picture goes in one direction.
void expect_fit(const TriangleSoup& soup, const char* view) {
  const Camera camera = camera_of(soup, view);
  double most_x = 0, most_y = 0;
  for (const Vec3d& point : soup.points) {
    const Camera::Place place = camera.place(point);
    ASSERT_TRUE(std::isfinite(place.x) && std::isfinite(place.y));
    most_x = std::max(most_x, std::abs(place.x - 100));
    most_y = std::max(most_y, std::abs(place.y - 50));
  }
  EXPECT_LE(most_x, 94 + 1e-9);
  EXPECT_LE(most_y, 47 + 1e-9);
  EXPECT_TRUE(most_x > 93.9 || most_y > 46.9) << most_x << " " << most_y;
}

TEST(Camera, FillsThePictureWhateverTheCoordinates) {
  const TriangleSoup soup = testing::torus(24, 12);
  for (const char* view : {"front", "top", "iso", "17,-60", "1e9,3"}) {
    for (const double size : {1.0, 1e300, 1e-300, 5.9e307, 1e-308}) {
      expect_fit(testing::scaled(soup, size), view);
    }
    expect_fit(testing::moved(soup, {1e6, -2e6, 3e6}), view);
  }
}

TEST(Camera, PassesOverTrianglesThatAreNotFinite) {
  TriangleSoup soup = testing::cube();
  const Camera alone = camera_of(soup, "iso");
  const auto bad = static_cast<std::uint32_t>(soup.points.size());
  soup.points.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  soup.points.push_back({1e9, 0, 0});
  soup.triangles.push_back({0, bad, bad + 1});
  const Camera with_more = camera_of(soup, "iso");
  EXPECT_EQ(alone.place({1, 1, 1}).x, with_more.place({1, 1, 1}).x);
  EXPECT_FALSE(std::isfinite(with_more.place(soup.points[bad]).x));
}

TEST(Camera, NeedsNoTriangle) {
  const Camera camera = camera_of({}, "iso");
  EXPECT_TRUE(std::isfinite(camera.place({1, 2, 3}).x));
}

TEST(Camera, RefusesSizesThatAreNone) {
  const TriangleSoup soup = testing::cube();
  EXPECT_THROW(Camera({}, {0, 5}, {&soup}), UsageError);
  EXPECT_THROW(Camera({}, {5, kMostPictureSide + 1}, {&soup}), UsageError);
}

TEST(Camera, NormalsAreOfTheFace) {
  const TriangleSoup soup = testing::cube();
  const Vec3d normal = camera_of(soup, "front").normal({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  EXPECT_NEAR(normal[2], 1, 1e-12);
  EXPECT_EQ(camera_of(soup, "front").normal({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), Vec3d::Zero());
}

}  // namespace
}  // namespace meshrepair
