// SPDX-License-Identifier: MIT
#include "drains/bore.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <check/internal/segments.h>
#include <hollow/hollow_options.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

// A triangle faces the drill if it is tilted by less than 53 degrees: the rim stays blunt, and no
// side of a box, nor of a prism of six sides, is a mouth together with its neighbour.
constexpr double kFacing = 0.6;
// Steps and grooves of less than this share of the wall are relief of the surface they are in.
constexpr double kRelief = 0.25;
// How much deeper than the wall the whole section gets: walls are thicker by their error at most.
constexpr double kDeeper = 2 * kHollowError;
// The bore gets through a wall that is tilted as far as a mouth may be: it is longer than the wall
// by 1 / kFacing, and its far side enters the surface later, by the tangent of the tilt.
constexpr double kLongestOfWall = 1 / kFacing;
constexpr double kLongestOfRadius = 1.34;
// How far it reaches out, in diameters: what is free.
constexpr std::array<double, 4> kReaches = {1, 0.75, 0.6, 0.55};
// The axis, and places around it.
constexpr double kHalf = 0.70710678118654752;
constexpr std::array<std::array<double, 2>, 9> kAround = {{{0, 0},
                                                           {1, 0},
                                                           {0, 1},
                                                           {-1, 0},
                                                           {0, -1},
                                                           {kHalf, kHalf},
                                                           {-kHalf, kHalf},
                                                           {-kHalf, -kHalf},
                                                           {kHalf, -kHalf}}};
constexpr int kMostWaySteps = 64;  // into the wall
// Coordinates of the result are rounded; the walls' bounds allow for as much.
constexpr double kForRounding = 0.1 * kHollowError;

struct Surroundings {
  std::vector<Corners> mouth;   // what the drill comes through
  std::vector<Corners> others;  // other parts of the surface
  std::vector<char> is_below;   // of these: not only outside, before the mouth
  std::size_t looked_at = 0;
};

Vec3d normal_of(const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

bool faces(const Corners& triangle, const Vec3d& inward) {
  const Vec3d normal = normal_of(triangle);
  return normal.dot(inward) <= -kFacing * normal.norm();
}

std::vector<Corners> triangles_in(const Depth& depth, const Box& box, std::size_t& looked_at) {
  std::vector<Corners> found;
  depth.visit([&](const Box& other) { return box.meets(other); },
              [&](const Corners& triangle) {
                ++looked_at;
                Box own;
                for (const Vec3d& corner : triangle) own.add(corner);
                if (box.meets(own)) found.push_back(triangle);
              });
  return found;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;

  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

using PointsOf = std::vector<std::array<std::uint32_t, 3>>;

PointsOf points_of(const std::vector<Corners>& triangles, std::size_t& count) {
  std::vector<Vec3d> points;
  PointWelder welder(points);
  PointsOf all;
  for (const Corners& t : triangles) {
    all.push_back({welder.index_of(t[0]), welder.index_of(t[1]), welder.index_of(t[2])});
  }
  count = points.size();
  return all;
}

void unite(DisjointSets& sets, const std::array<std::uint32_t, 3>& points) {
  sets.join(points[0], points[1]);
  sets.join(points[0], points[2]);
}

// Triangles that do not face the drill, but hang together over small depths alone, are relief.
std::vector<char> is_mouth_like(const std::vector<Corners>& triangles, const PointsOf& points,
                                std::size_t count, const Vec3d& inward, double relief) {
  std::vector<char> like(triangles.size());
  DisjointSets sets(count);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    like[t] = faces(triangles[t], inward);
    if (like[t] == 0) unite(sets, points[t]);
  }
  std::vector<Range> depths(count);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (like[t] != 0) continue;
    for (const Vec3d& p : triangles[t]) depths[sets.root(points[t][0])].add(p.dot(inward));
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (like[t] != 0) continue;
    const Range& range = depths[sets.root(points[t][0])];
    like[t] = range.high - range.low <= relief;
  }
  return like;
}

Surroundings surroundings(const Depth& depth, const Vec3d& mouth, const Vec3d& inward,
                          const Corners& at, const BoreSize& size) {
  const double radius = 0.5 * kWidestPrism * size.diameter;
  Box box;
  box.add(mouth - size.diameter * inward);
  box.add(mouth +
          (kLongestOfWall * (1 + kDeeper) * size.wall + kLongestOfRadius * radius) * inward);
  box.widen(radius + (1 + kDeeper) * size.wall);
  Surroundings found;
  const std::vector<Corners> near = triangles_in(depth, box, found.looked_at);
  std::size_t count = 0;
  const PointsOf points = points_of(near, count);
  const std::vector<char> like = is_mouth_like(near, points, count, inward, kRelief * size.wall);
  DisjointSets sets(count);
  for (std::size_t t = 0; t < near.size(); ++t) {
    if (like[t] != 0) unite(sets, points[t]);
  }
  const auto own = std::find(near.begin(), near.end(), at);
  if (own == near.end()) return found;
  const std::uint32_t set = sets.root(points[static_cast<std::size_t>(own - near.begin())][0]);
  const double before = 1e-6 * (radius + size.wall);
  for (std::size_t t = 0; t < near.size(); ++t) {
    if (like[t] != 0 && sets.root(points[t][0]) == set) {
      found.mouth.push_back(near[t]);
      continue;
    }
    found.others.push_back(near[t]);
    found.is_below.push_back(std::any_of(near[t].begin(), near[t].end(), [&](const Vec3d& p) {
      return (p - mouth).dot(inward) > before;
    }));
  }
  return found;
}

double squared_length(const Segment& s) { return (s.to - s.from).squaredNorm(); }

void take_shorter(Segment& shortest, const Segment& other) {
  if (squared_length(other) < squared_length(shortest)) shortest = other;
}

// From the segment to the triangle: at an end of the segment, at an edge, or where they cross.
Segment shortest_between(const Segment& segment, const Corners& triangle) {
  Segment shortest = {segment.from, nearest_point(segment.from, triangle)};
  take_shorter(shortest, {segment.to, nearest_point(segment.to, triangle)});
  for (std::size_t i = 0; i < 3; ++i) {
    take_shorter(shortest, shortest_between(segment, Segment{triangle[i], triangle[(i + 1) % 3]}));
  }
  const Vec3d normal = normal_of(triangle);
  const double a = normal.dot(segment.from - triangle[0]);
  const double b = normal.dot(segment.to - triangle[0]);
  if ((a < 0) != (b < 0)) {
    const Vec3d crossing = segment.from + a / (a - b) * (segment.to - segment.from);
    take_shorter(shortest, {crossing, nearest_point(crossing, triangle)});
  }
  return shortest;
}

// How far along a line it is as deep below the surface at the mouth as it is to be: no step passes
// that. All of that surface faces the drill, so what is before its nearest point is outside.
std::optional<double> way_through(const NearestTriangle& mouth, const Vec3d& from,
                                  const Vec3d& inward, double depth, double longest) {
  double way = 0;
  for (int step = 0; step < kMostWaySteps && way <= longest; ++step) {
    const Vec3d at = from + way * inward;
    const Nearest found = mouth.find(at, 0);
    const Vec3d foot = nearest_point(at, mouth.triangles()[found.triangle]);
    const double below = std::copysign(std::sqrt(found.squared_distance), (at - foot).dot(inward));
    if (below >= (1 - 1e-9) * depth) return way;
    way += std::max(depth - below, 1e-3 * depth);
  }
  return std::nullopt;
}

// The longest of the axis and of lines along the sides.
std::optional<double> length_of(const Surroundings& around, const Vec3d& mouth, const Vec3d& inward,
                                const BoreSize& size) {
  const double wall = (1 + kDeeper) * size.wall, radius = 0.5 * kWidestPrism * size.diameter;
  const double longest = kLongestOfWall * wall + kLongestOfRadius * radius;
  const NearestTriangle nearest(around.mouth);
  const auto [u, v] = across(inward);
  double length = 0;
  for (const auto& [x, y] : kAround) {
    const Vec3d start = mouth + radius * (x * u + y * v);
    const auto way = way_through(nearest, start, inward, wall, longest);
    if (!way) return std::nullopt;
    length = std::max(length, *way);
  }
  return length;
}

void look_beside(const Surroundings& around, const Segment& axis, const BoreSize& size,
                 Bore& bore) {
  const double radius = 0.5 * kWidestPrism * size.diameter;
  Segment shortest = {
      axis.from, axis.from + (radius + (1 + kDeeper) * size.wall) * across(axis.to - axis.from).u};
  const Corners* nearest = nullptr;
  for (std::size_t t = 0; t < around.others.size(); ++t) {
    if (around.is_below[t] == 0) continue;
    const Segment other = shortest_between(axis, around.others[t]);
    if (squared_length(other) >= squared_length(shortest)) continue;
    shortest = other;
    nearest = &around.others[t];
  }
  const double distance = std::sqrt(squared_length(shortest));
  bore.beside = distance - radius - kForRounding * size.wall;
  if (nearest == nullptr) return;
  const Vec3d inward = (axis.to - axis.from).normalized();
  Vec3d away = shortest.from - shortest.to;
  if (distance < 1e-3 * radius) away = -normal_of(*nearest).normalized();
  away -= away.dot(inward) * inward;
  if (away.norm() > 0) bore.away = away.normalized();
}

// The end outside is free, and the way to it: other parts of the surface are beside.
double free_reach(const Depth& depth, const Surroundings& around, const Vec3d& mouth,
                  const Vec3d& inward, std::uint32_t position, double diameter) {
  const double radius = 0.5 * kWidestPrism * diameter;
  for (const double reach : kReaches) {
    const Place from = depth.place(mouth - reach * diameter * inward, position);
    // Where the end is free, a ball around it is.
    if (from.distance < 1.005 * radius || depth.is_inside(from.at)) continue;
    const bool is_free =
        std::all_of(around.others.begin(), around.others.end(), [&](const Corners& triangle) {
          const Segment way = {mouth, from.at};
          return squared_length(shortest_between(way, triangle)) > radius * radius;
        });
    if (is_free) return reach;
  }
  return 0;
}

}  // namespace

Across across(const Vec3d& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3d u = axis.cross(Vec3d::Unit(least)).normalized();
  return {u, axis.normalized().cross(u)};
}

std::optional<Bore> bore_at(const Depth& depth, const Vec3d& mouth, const Vec3d& inward,
                            std::uint32_t position, const BoreSize& size) {
  const Corners& at = depth.triangles()[position];
  if (!faces(at, inward)) return std::nullopt;
  const Surroundings around = surroundings(depth, mouth, inward, at, size);
  if (around.mouth.empty()) return std::nullopt;
  const auto length = length_of(around, mouth, inward, size);
  if (!length) return std::nullopt;
  Bore bore;
  bore.length = *length;
  look_beside(around, {mouth, mouth + *length * inward}, size, bore);
  bore.reach = free_reach(depth, around, mouth, inward, position, size.diameter);
  bore.looked_at = around.looked_at;
  return bore;
}

}  // namespace meshrepair::internal
