// SPDX-License-Identifier: MIT
#include "drains/place_drains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include <mesh/mesh_parts.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kSides = 32;  // a power of two, from 4 on
constexpr std::size_t kMostTried = 20000;
constexpr double kApart = 2;  // diameters, at least, between two drains of a cavity

// The ball at the inner end of a drain may be so much smaller, where others fit nowhere.
constexpr std::array<double, 3> kBalls = {0.999, 0.75, 0.5};
// How far it reaches out, in diameters: what is free.
constexpr std::array<double, 4> kReaches = {1, 0.75, 0.6, 0.55};

// The directions of a regular polygon's corners, by halving angles: sines differ between systems.
std::vector<Vec3d> around(const Vec3d& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3d u = axis.cross(Vec3d::Unit(least)).normalized();
  const Vec3d v = axis.cross(u);
  std::vector<Vec3d> directions = {u, v, -u, -v};
  while (directions.size() < kSides) {
    std::vector<Vec3d> finer;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      finer.push_back(directions[i]);
      finer.emplace_back((directions[i] + directions[(i + 1) % directions.size()]).normalized());
    }
    directions = std::move(finer);
  }
  return directions;
}

// Of its corners, where the cylinder's is 1.
double radius_of_prism(const std::vector<Vec3d>& directions) {
  return 1 / (0.5 * (directions[0] + directions[1])).norm();
}

std::vector<char> triangles_of_outsides(const TriangleSoup& solid) {
  const MeshParts parts = find_parts(solid);
  const UnitScale scale(solid.points);
  const std::vector<PartSize> sizes =
      part_sizes(solid.points, solid.triangles, parts.of_triangle, parts.count, scale);
  std::vector<char> outside;
  outside.reserve(solid.triangles.size());
  for (const std::uint32_t part : parts.of_triangle) outside.push_back(sizes[part].volume > 0);
  return outside;
}

}  // namespace

DrainPlacer::DrainPlacer(const TriangleSoup& solid, const Depth& depth,
                         const HollowOptions& options)
    : depth_(depth), options_(options), outside_(triangles_of_outsides(solid)) {}

bool DrainPlacer::is_on_outside(std::uint32_t nearest) const {
  return outside_[depth_.number(nearest)] != 0;
}

// The end within is far from all walls, and the end outside is free: both discs are in balls.
std::optional<Drill> DrainPlacer::drill(const Vec3d& mouth, const Vec3d& inward, const Vec3d& end,
                                        std::uint32_t nearest) const {
  if (!is_on_outside(nearest)) return std::nullopt;
  for (const double reach : kReaches) {
    const Place from = depth_.place(mouth - reach * options_.drain * inward, nearest);
    // A prism of so many sides is less than 1 % wider than its cylinder.
    if (from.distance < 0.505 * options_.drain || depth_.is_inside(from.at)) continue;
    return Drill{{mouth, inward}, from.at, end};
  }
  return std::nullopt;
}

// At right angles to the surface, through the place of the inner side.
std::optional<Drill> DrainPlacer::through(const Place& wall) const {
  const Vec3d inward = depth_.inward(wall);
  const double radius = 0.5 * options_.drain;
  for (const double share : kBalls) {
    const Place end = depth_.place(wall.at + share * radius * inward, wall.nearest);
    if (end.distance < options_.wall + 0.999 * share * radius) continue;
    return drill(depth_.foot(wall), inward, end.at, wall.nearest);
  }
  return std::nullopt;
}

namespace {

Vec3d nearest_of(const Vec3d& point, const std::vector<Corners>& triangles) {
  Vec3d nearest = triangles[0][0];
  for (const Corners& triangle : triangles) {
    const Vec3d other = nearest_point(point, triangle);
    if ((other - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = other;
  }
  return nearest;
}

}  // namespace

double DrainPlacer::distance(const Vec3d& point, const CavityPlaces& cavity) const {
  const Vec3d mouth = depth_.foot(depth_.place(point, 0));
  return (nearest_of(mouth, cavity.triangles) - mouth).norm();
}

std::optional<Drill> DrainPlacer::from_point(const Vec3d& point, const CavityPlaces& cavity) const {
  const Place given = depth_.place(point, 0);
  const Vec3d mouth = depth_.foot(given);
  const Vec3d wall = nearest_of(mouth, cavity.triangles);
  const Vec3d inward = (wall - mouth).normalized();
  for (double share = 1; share > 0.1; share *= 0.5) {
    const Place end = depth_.place(wall + share * 0.5 * options_.drain * inward, given.nearest);
    // Walls are less deep by their error at most.
    if (end.distance > (1 + kHollowError) * options_.wall) {
      return drill(mouth, inward, end.at, given.nearest);
    }
  }
  return std::nullopt;
}

std::vector<Drill> DrainPlacer::for_cavity(const CavityPlaces& cavity) const {
  std::vector<std::uint32_t> order(cavity.corners.size());
  std::iota(order.begin(), order.end(), 0);
  const auto first_by = [&](const auto& key) -> std::optional<Drill> {
    std::vector<double> keys;
    for (const Place& wall : cavity.corners) keys.push_back(key(wall.at));
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
    });
    for (std::size_t i = 0; i < std::min(order.size(), kMostTried); ++i) {
      if (auto found = through(cavity.corners[order[i]])) return found;
    }
    return std::nullopt;
  };
  std::vector<Drill> drills;
  auto low = first_by([&](const Vec3d& p) { return p.dot(options_.up); });
  if (!low) {  // but where the largest ball is, one fits
    const Place& deep = cavity.deepest;
    low = drill(depth_.foot(deep), depth_.inward(deep), deep.at, deep.nearest);
  }
  if (!low) return drills;
  drills.push_back(*low);
  const Vec3d& at = drills[0].drain.at;
  const auto far = first_by([&](const Vec3d& p) { return -(p - at).squaredNorm(); });
  if (far && (far->drain.at - at).norm() >= kApart * options_.drain) drills.push_back(*far);
  return drills;
}

TriangleSoup DrainPlacer::prism(const Drill& drill) const {
  const std::vector<Vec3d> directions = around(drill.drain.direction);
  const double radius = 0.5 * options_.drain * radius_of_prism(directions);
  TriangleSoup soup;
  soup.points = {drill.from, drill.to};
  for (const Vec3d& direction : directions) {
    soup.points.emplace_back(drill.from + radius * direction);
    soup.points.emplace_back(drill.to + radius * direction);
  }
  const auto sides = static_cast<std::uint32_t>(directions.size());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
    soup.triangles.push_back({0, b, a});
    soup.triangles.push_back({1, a + 1, b + 1});
    soup.triangles.push_back({a, b, b + 1});
    soup.triangles.push_back({a, b + 1, a + 1});
  }
  return soup;
}

}  // namespace meshrepair::internal
