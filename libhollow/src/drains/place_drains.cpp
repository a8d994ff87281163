// SPDX-License-Identifier: MIT
#include "drains/place_drains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_set>
#include <utility>

#include <Eigen/Geometry>

#include <base/internal/hash_index.h>
#include <check/internal/segments.h>
#include <check/soup_rays.h>
#include <mesh/mesh_parts.h>
#include <mesh/weld_points.h>

#include "drains/bore.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kSides = 32;  // a power of two, from 4 on
constexpr std::size_t kMostTried = 20000;
constexpr std::size_t kMostLookedAt = 5'000'000;  // triangles: some seconds
constexpr double kApart = 2;  // diameters, at least, between two drains of a cavity
constexpr int kMostSlides = 8;
constexpr double kNearlyUpright = 0.9;  // the cosine of 26 degrees
constexpr double kAsLow = 0.25;         // of a radius: no lower place is looked for
// Places nearer to one that was tried than this share of a radius are as bad.
constexpr double kSamePlace = 0.125;
// Where less than this share of the wall would be left beside it, nothing is drilled.
constexpr double kLeastBeside = 0.1;

// The directions of a regular polygon's corners, by halving angles: sines differ between systems.
std::vector<Vec3d> around(const Vec3d& axis) {
  const auto [u, v] = across(axis);
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

TriangleSoup soup_of(const std::vector<Corners>& triangles) {
  TriangleSoup soup;
  PointWelder welder(soup.points);
  for (const Corners& t : triangles) {
    soup.triangles.push_back({welder.index_of(t[0]), welder.index_of(t[1]), welder.index_of(t[2])});
  }
  return soup;
}

Vec3d nearest_of(const Vec3d& point, const std::vector<Corners>& triangles) {
  Vec3d nearest = triangles[0][0];
  for (const Corners& triangle : triangles) {
    const Vec3d other = nearest_point(point, triangle);
    if ((other - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = other;
  }
  return nearest;
}

Segment within(const Drill& drill) { return {drill.drain.at, drill.to}; }

}  // namespace

DrainPlacer::DrainPlacer(const TriangleSoup& solid, const Depth& depth,
                         const HollowOptions& options)
    : depth_(depth), options_(options), outside_(triangles_of_outsides(solid)) {}

bool DrainPlacer::is_on_outside(std::uint32_t nearest) const {
  return outside_[depth_.number(nearest)] != 0;
}

double DrainPlacer::between(const Drill& a, const Drill& b) const {
  const Segment shortest = shortest_between(within(a), within(b));
  return (shortest.to - shortest.from).norm() - kWidestPrism * options_.drain;
}

double DrainPlacer::distance(const Vec3d& point, const CavityPlaces& cavity) const {
  const Vec3d mouth = depth_.foot(depth_.place(point, 0));
  return (nearest_of(mouth, cavity.triangles) - mouth).norm();
}

// Among places of one cavity.
class DrainPlacer::Search {
 public:
  Search(const DrainPlacer& placer, const CavityPlaces& cavity, std::span<const Drill> others)
      : placer_(placer),
        depth_(placer.depth_),
        wall_(placer.options_.wall),
        drain_(placer.options_.drain),
        enough_((1 - kHollowError) * wall_),
        others_(others.begin(), others.end()),
        walls_(soup_of(cavity.triangles)),
        winding_(walls_.triangles.size(), 1),
        rays_(walls_, winding_) {}

  [[nodiscard]] bool leaves_enough(const Drill& drill) const {
    return drill.drain.beside >= enough_;
  }
  void avoid(const Drill& drill) { others_.push_back(drill); }

  // Nothing where it does not get into the cavity, or where its end outside is not free.
  [[nodiscard]] std::optional<Drill> drill(const Vec3d& mouth, const Vec3d& inward,
                                           std::uint32_t nearest) {
    away_ = Vec3d::Zero();
    if (!placer_.is_on_outside(nearest)) return std::nullopt;
    const auto bore = bore_at(depth_, mouth, inward, nearest, {wall_, drain_});
    looked_at_ += kOfOne;
    if (!bore) return std::nullopt;
    looked_at_ += bore->looked_at;
    beside_ = bore->beside;
    away_ = bore->away;
    if (bore->reach == 0) return std::nullopt;
    Drill drill{{mouth, inward, bore->beside},
                mouth - bore->reach * drain_ * inward,
                mouth + bore->length * inward};
    if (rays_.winding_at(drill.to) <= 0) return std::nullopt;
    for (const Drill& other : others_) {
      drill.drain.beside = std::min(drill.drain.beside, placer_.between(drill, other));
    }
    drill.drain.beside = std::min(drill.drain.beside, wall_);
    return drill;
  }

  // At right angles to the surface, through this place; where other parts of the surface are too
  // near, moved away from them step by step. Of these, the one that leaves most.
  [[nodiscard]] std::optional<Drill> near(Place wall) {
    std::optional<Drill> best;
    for (int slide = 0; slide <= kMostSlides; ++slide) {
      if (!tried_.insert(cell_of(wall.at)).second) break;
      const Vec3d mouth = depth_.foot(wall), inward = depth_.inward(wall);
      const auto found = drill(mouth, inward, wall.nearest);
      if (found && (!best || found->drain.beside > best->drain.beside)) best = found;
      if ((best && leaves_enough(*best)) || away_ == Vec3d::Zero() || beside_ >= enough_) break;
      const double by = (1 + kHollowError) * wall_ - beside_;
      wall = depth_.place(mouth + wall_ * inward + by * away_, wall.nearest);
      if (wall.distance < kLeastBeside * wall_ || !depth_.is_inside(wall.at)) break;
    }
    return best;
  }

  // Of those that leave enough, the one with the least cost, but for a slack. A place near a corner
  // costs no less than the corner's key, or little less. Where none leaves enough, the one that
  // leaves most.
  template <class Key, class Cost, class Fits>
  [[nodiscard]] std::optional<Drill> best_by(const std::vector<Place>& corners, const Key& key,
                                             const Cost& cost, const Fits& fits) {
    std::vector<double> keys;
    keys.reserve(corners.size());
    for (const Place& wall : corners) keys.push_back(key(wall.at));
    std::vector<std::uint32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
    });
    std::optional<Drill> best;
    double least = std::numeric_limits<double>::infinity();
    tried_.clear();
    looked_at_ = 0;
    for (const std::uint32_t i : order) {
      if (tried_.size() >= kMostTried || looked_at_ >= kMostLookedAt || keys[i] >= least) break;
      const auto found = near(corners[i]);
      if (!found || !fits(*found)) continue;
      const bool is_enough = leaves_enough(*found);
      if (is_enough ? cost(*found) >= least : best && found->drain.beside <= best->drain.beside) {
        continue;
      }
      best = found;
      if (is_enough) least = cost(*found);
    }
    return best;
  }

 private:
  // Two cells may have the same number: then some place is not tried.
  [[nodiscard]] std::uint64_t cell_of(const Vec3d& at) const {
    std::uint64_t cell = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto step = static_cast<std::int64_t>(std::floor(at[k] / (kSamePlace * 0.5 * drain_)));
      cell = hash_mix(cell, static_cast<std::uint64_t>(step));
    }
    return cell;
  }

  static constexpr std::size_t kOfOne = 100;  // work besides that for triangles

  const DrainPlacer& placer_;
  const Depth& depth_;
  double wall_, drain_, enough_;
  std::vector<Drill> others_;
  TriangleSoup walls_;
  std::vector<std::int32_t> winding_;
  SoupRays rays_;
  Vec3d away_ = Vec3d::Zero();  // of what was looked at last
  double beside_ = 0;
  std::size_t looked_at_ = 0;
  std::unordered_set<std::uint64_t> tried_;
};

// At right angles to the surface; where that leaves less, or does not get into the cavity, on the
// shortest way if that is nearly the same: beside an edge, it would lead through both faces.
std::optional<Drill> DrainPlacer::from_point(const Vec3d& point, const CavityPlaces& cavity,
                                             std::span<const Drill> others) const {
  Search search(*this, cavity, others);
  const Place given = depth_.place(point, 0);
  const Vec3d mouth = depth_.foot(given);
  const Corners& t = depth_.triangles()[given.nearest];
  const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  std::optional<Drill> best;
  for (const Vec3d& inward : {Vec3d(-normal.normalized()),
                              Vec3d((nearest_of(mouth, cavity.triangles) - mouth).normalized())}) {
    if (-normal.dot(inward) < kNearlyUpright * normal.norm()) continue;
    const auto found = search.drill(mouth, inward, given.nearest);
    if (found && (!best || found->drain.beside > best->drain.beside)) best = found;
    if (best && search.leaves_enough(*best)) break;
  }
  return best;
}

std::vector<Drill> DrainPlacer::for_cavity(const CavityPlaces& cavity,
                                           std::span<const Drill> others) const {
  Search search(*this, cavity, others);
  const double least = kLeastBeside * options_.wall;
  const auto is_left = [&](const Drill& drill) { return drill.drain.beside >= least; };
  const auto height = [&](const Vec3d& p) { return p.dot(options_.up); };
  // Of the middle of the hole, within the cavity.
  const auto level = [&](const Drill& drill) {
    return height(drill.drain.at + options_.wall * drill.drain.direction) -
           kAsLow * 0.5 * options_.drain;
  };
  auto low = search.best_by(cavity.corners, height, level, is_left);
  if (!low || !search.leaves_enough(*low)) {  // where the largest ball is, one may fit
    const auto deep = search.near(cavity.deepest);
    if (deep && is_left(*deep) && (!low || deep->drain.beside > low->drain.beside)) low = deep;
  }
  if (!low) return {};
  const Vec3d& at = low->drain.at;
  search.avoid(*low);
  const double as_good = std::min((1 - kHollowError) * options_.wall, low->drain.beside);
  const auto far = search.best_by(
      cavity.corners, [&](const Vec3d& p) { return -(p - at).squaredNorm(); },
      [](const Drill&) { return -std::numeric_limits<double>::infinity(); },
      [&](const Drill& drill) {
        return drill.drain.beside >= as_good &&
               (drill.drain.at - at).norm() >= kApart * options_.drain;
      });
  if (far) return {*low, *far};
  return {*low};
}

TriangleSoup prism_of(const Drill& drill, double diameter) {
  const std::vector<Vec3d> directions = around(drill.drain.direction);
  const double radius = 0.5 * diameter * radius_of_prism(directions);
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
