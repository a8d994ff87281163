// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <exact/predicates.h>

#include "random_geometry.h"

namespace meshrepair {
namespace {

using testing::Random;

Plane random_plane_through(Random& random, const GridPoint& p, std::int32_t radius) {
  Plane plane;
  do {
    plane = plane_through(p, random.grid_point(radius), random.grid_point(radius));
  } while (is_null(plane));
  return plane;
}

// A plane with points on it, each given by that plane and two others.
struct Scene {
  PlaneTable planes;
  PlaneId plane;
  std::vector<Point> points;
};

Scene scene(Random& random, std::size_t count, std::int32_t radius) {
  Scene s;
  s.plane = s.planes.append(random_plane_through(random, random.grid_point(radius), radius));
  while (s.points.size() < count) {
    const PlaneId a =
        s.planes.append(random_plane_through(random, random.grid_point(radius), radius));
    const PlaneId b =
        s.planes.append(random_plane_through(random, random.grid_point(radius), radius));
    const Point p = meet(s.planes, s.plane, a, b, {});
    if (!p.is_loose()) s.points.push_back(p);
  }
  return s;
}

TEST(Turn, ChangesSignWithTheOrderOfThePoints) {
  Random random(1);
  for (const std::int32_t radius : {4, 40, kGridRadius}) {
    for (int i = 0; i < 300; ++i) {
      const Scene s = scene(random, 3, radius);
      const auto& p = s.points;
      const int t = turn(p[0], p[1], p[2], s.plane, s.planes);
      EXPECT_EQ(turn(p[1], p[2], p[0], s.plane, s.planes), t);
      EXPECT_EQ(turn(p[1], p[0], p[2], s.plane, s.planes), -t);
      EXPECT_EQ(turn(p[0], p[0], p[2], s.plane, s.planes), 0);
    }
  }
}

// The line through two of the points as a plane: the third point's side of it is the turn.
TEST(Turn, AgreesWithTheSideOfAPlane) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    Scene s = scene(random, 1, 1000);
    const GridPoint a = random.grid_point(1000), b = random.grid_point(1000),
                    c = random.grid_point(1000);
    const Plane plane = plane_through(a, b, c);
    if (is_null(plane)) continue;
    const PlaneId id = s.planes.append(plane);
    EXPECT_EQ(turn(lattice_point(a), lattice_point(b), lattice_point(c), id, s.planes), 1);
    const PlaneId cut = s.planes.append(random_plane_through(random, c, 1000));
    const PlaneId line = s.planes.append(plane_along_axis(a, b, dominant_axis(plane)));
    const PlaneId other = s.planes.append(random_plane_through(random, b, 1000));
    const Point p = meet(s.planes, id, cut, other, {});
    if (p.is_loose()) continue;
    const int expected = side(lattice_point(c), line, s.planes) * side(p, line, s.planes);
    EXPECT_EQ(turn(lattice_point(a), lattice_point(b), p, id, s.planes), expected);
  }
}

// Three points on the common line of two planes, known by other planes alone.
TEST(Turn, SeesStraightLinesThroughPointsThatShareNoPlane) {
  Random random(3);
  int seen = 0;
  for (int i = 0; i < 300; ++i) {
    const GridPoint a = random.grid_point(), b = random.grid_point();
    PlaneTable planes;
    const PlaneId plane = planes.append(plane_through(a, b, random.grid_point()));
    std::vector<Point> points;
    while (points.size() < 3) {
      // Each time another plane through the same line.
      const PlaneId line = planes.append(plane_through(a, b, random.grid_point()));
      const PlaneId cut = planes.append(random_plane_through(random, random.grid_point(), 1000000));
      const Point p = meet(planes, plane, line, cut, {});
      if (p.is_loose()) break;
      points.push_back(p);
    }
    if (points.size() < 3) continue;
    ++seen;
    EXPECT_EQ(turn(points[0], points[1], points[2], plane, planes), 0);
    EXPECT_EQ(turn(points[0], lattice_point(a), points[2], plane, planes), 0);
  }
  EXPECT_GT(seen, 20);
}

}  // namespace
}  // namespace meshrepair
