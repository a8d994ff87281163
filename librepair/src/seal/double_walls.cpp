// SPDX-License-Identifier: MIT
// How the inner wall of a body is found (what it is, the header says):
//
// 1. Samples, more where triangles are large, are looked at along rays to all sides: seen from
//    outside, where many escape, or not.
// 2. From each one that is seen a ray goes inward. Where most find a wall soon behind them that
//    faces them and is not seen, the body has two walls, and the distances tell how thick they are.
// 3. A minimum cut over the triangles, each edge weighing its length, parts what is seen from what
//    lies behind: its rims are the openings. Where they run the cut decides, not the rays, which
//    tell little beside an opening.
// 4. Pieces of the inner wall stay whose openings are all pinholes. From their rims on, the tubes
//    that lead to the outer wall are added: triangles that have no wall behind them where one would
//    be.
//
// Rays are rounded, and nothing depends on one alone.
#include "double_walls.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include <base/angles.h>
#include <base/disjoint_sets.h>
#include <base/error.h>
#include <base/parallel.h>
#include <mesh/edge_table.h>
#include <mesh/internal/triangle_measures.h>
#include <mesh/mesh_parts.h>

#include "common/minimum_cut.h"
#include "triangle_rays.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kFewestTriangles = 2000;

// All lengths are shares of the diagonal of the body's bounding box.
constexpr double kThickestOnAverage = 0.06;  // volume by half of the area
constexpr double kThickest = 0.08;

// Rays to all sides. More than the first share of those that leave a triangle escape where it is
// seen, fewer than the second where it is not.
constexpr std::size_t kRays = 32;
constexpr double kSeen = 0.3;
constexpr double kUnseen = 0.1;
// Rays nearly along a triangle tell nothing.
constexpr double kSteepest = 0.1;

// Of the triangles that are seen: behind so many lies a wall, and so many of these are not seen.
constexpr double kMostHaveWalls = 0.7;
constexpr double kMostWallsUnseen = 0.8;
constexpr double kFacesSeen = -0.5;  // cosine

// Smaller pieces of the inner wall, by area, are triangles that were taken for it by mistake.
constexpr double kLeastOfBody = 0.05;

// Pinholes: see the header. Together they have at most so much of the inner wall's area, or twice
// of that.
constexpr double kNarrowPinhole = 0.01;
constexpr std::size_t kFewEdges = 12, kSomeEdges = 80;
constexpr double kWidestOfFewEdges = 0.08;
constexpr std::size_t kMany = 6;
constexpr double kMostAreNarrow = 0.7;
constexpr double kShortestEdge = 0.5;  // in mean edges
constexpr double kMostOfWall = 0.1;

// A tube's wall is so much thicker than the body's walls, seen along its normal.
constexpr double kTube = 2.5;

std::vector<Vec3d> ray_directions() {
  std::vector<Vec3d> directions;
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t i = 0; i < kRays; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / kRays;
    const double radius = std::sqrt(1 - z * z);
    const auto [cosine, sine] = cosine_and_sine(turn * static_cast<double>(i));
    directions.emplace_back(radius * cosine, radius * sine, z);
  }
  return directions;
}

// What one opening of a wall ends at.
struct PinholeRim {
  std::size_t edges = 0;
  double length = 0;
  [[nodiscard]] double width() const { return length / std::numbers::pi; }
  [[nodiscard]] double area() const { return length * length / (4 * std::numbers::pi); }
};

class BodyWalls {
 public:
  explicit BodyWalls(const TriangleSoup& body) : body_(body) {
    const std::size_t triangles = body.triangles.size();
    Box box;
    for (const Vec3d& p : body.points) box.add(p);
    diagonal_ = box.diagonal();
    area_.resize(triangles);
    double total = 0;
    for (std::size_t t = 0; t < triangles; ++t) {
      const auto& [a, b, c] = body.triangles[t];
      area_[t] = triangle_area(body.points[a], body.points[b], body.points[c]);
      total += area_[t];
    }
    total_area_ = total;
    // Of triangles with equal sides.
    mean_edge_ = std::sqrt(4 / std::numbers::sqrt3 * total / static_cast<double>(triangles));
  }

  // Of each triangle, whether it is of the inner wall or a tube; empty if there is no such wall.
  std::vector<char> run() {
    rays_.emplace(body_);
    look_from_samples();
    if (!has_facing_walls()) return {};
    sides_ = EdgeTable(body_.triangles);
    std::vector<char> inner = cut_apart();
    keep_walls(inner);
    if (rims_.empty()) return {};
    drop_tubes(inner);
    return inner;
  }

  [[nodiscard]] const std::vector<PinholeRim>& pinholes() const { return rims_; }

 private:
  enum class Sight : char { none, seen, unseen };

  // A triangle, and the one behind it.
  struct Sample {
    std::uint32_t triangle = 0;
    Sight sight = Sight::none;
    std::optional<RayHit> wall = {};  // facing it
    Sight wall_sight = Sight::none;
  };

  [[nodiscard]] Vec3d normal(std::uint32_t t) const {
    const auto& [a, b, c] = body_.triangles[t];
    const Vec3d& at = body_.points[a];
    return (body_.points[b] - at).cross(body_.points[c] - at).normalized();
  }

  [[nodiscard]] Sight sight_of(std::uint32_t t) const {
    static const std::vector<Vec3d> directions = ray_directions();
    const Vec3d up = normal(t);
    int rays = 0, escaped = 0;
    for (const Vec3d& direction : directions) {
      if (direction.dot(up) < kSteepest) continue;
      ++rays;
      escaped += rays_->escapes(t, direction) ? 1 : 0;
    }
    if (escaped >= kSeen * rays) return Sight::seen;
    return escaped <= kUnseen * rays ? Sight::unseen : Sight::none;
  }

  // The more the larger triangles are.
  void choose_samples() {
    const std::size_t wanted = std::clamp<std::size_t>(body_.triangles.size() / 16, 256, 8192);
    const double step = total_area_ / static_cast<double>(wanted);
    double next = 0.5 * step, sum = 0;
    for (std::uint32_t t = 0; t < body_.triangles.size(); ++t) {
      sum += area_[t];
      if (sum < next) continue;
      samples_.push_back({t});
      while (next <= sum) next += step;
    }
  }

  void look_from_samples() {
    choose_samples();
    parallel_for(samples_.size(), [&](std::size_t i) {
      Sample& sample = samples_[i];
      sample.sight = sight_of(sample.triangle);
      if (sample.sight != Sight::seen) return;
      const Vec3d down = -normal(sample.triangle);
      const RayHit hit = rays_->first_hit(sample.triangle, down, kThickest * diagonal_);
      if (!std::isfinite(hit.distance) || normal(hit.triangle).dot(-down) > kFacesSeen) return;
      sample.wall = hit;
      sample.wall_sight = sight_of(hit.triangle);
    });
  }

  [[nodiscard]] bool has_facing_walls() {
    std::size_t seen = 0, unseen_walls = 0;
    std::vector<double> thickness;
    for (const Sample& sample : samples_) {
      seen += sample.sight == Sight::seen ? 1 : 0;
      if (sample.wall) thickness.push_back(sample.wall->distance);
      unseen_walls += sample.wall_sight == Sight::unseen ? 1 : 0;
    }
    const auto walls = static_cast<double>(thickness.size());
    if (walls == 0 || walls < kMostHaveWalls * static_cast<double>(seen)) return false;
    if (static_cast<double>(unseen_walls) < kMostWallsUnseen * walls) return false;
    const auto middle = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 2);
    std::nth_element(thickness.begin(), middle, thickness.end());
    thickness_ = *middle;
    return true;
  }

  [[nodiscard]] double length_at(std::uint32_t side) const {
    return (body_.points[side_start(body_.triangles, side)] -
            body_.points[side_start(body_.triangles, next_side(side))])
        .norm();
  }

  // Of each triangle, whether it is on the side of the inner wall.
  [[nodiscard]] std::vector<char> cut_apart() const {
    std::vector<CutNode> nodes(body_.triangles.size());
    for (const Sample& sample : samples_) {
      if (sample.wall_sight != Sight::unseen) continue;
      nodes[sample.triangle] = {kForbidden, 0};
    }
    for (const Sample& sample : samples_) {
      if (sample.wall_sight != Sight::unseen) continue;
      CutNode& node = nodes[sample.wall->triangle];
      if (node.in == 0) node.out = kForbidden;
    }
    constexpr double kSteps = 1 << 26;
    std::vector<CutEdge> edges;
    sides_->for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() != 2) return;
      const double length = std::min(length_at(sides[0]) / diagonal_, 1.0);
      edges.push_back({sides[0] / 3, sides[1] / 3, 1 + std::llround(kSteps * length)});
    });
    return minimum_cut(nodes, edges);
  }

  // What of `inner` is a wall whose openings are all pinholes, and these.
  void keep_walls(std::vector<char>& inner) {
    DisjointSets pieces(body_.triangles.size()), rims(body_.points.size());
    std::vector<std::uint32_t> rim_sides;
    sides_->for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() != 2) return;
      const std::uint32_t a = sides[0] / 3, b = sides[1] / 3;
      if (inner[a] == inner[b]) {
        pieces.join(a, b);
      } else {
        rim_sides.push_back(inner[a] != 0 ? sides[0] : sides[1]);
        rims.join(side_start(body_.triangles, sides[0]),
                  side_start(body_.triangles, next_side(sides[0])));
      }
    });
    std::vector<double> area(body_.triangles.size(), 0);
    for (std::uint32_t t = 0; t < area_.size(); ++t) area[pieces.root(t)] += area_[t];
    std::map<std::uint32_t, std::map<std::uint32_t, PinholeRim>> rims_of;  // of each piece
    for (const std::uint32_t side : rim_sides) {
      PinholeRim& rim =
          rims_of[pieces.root(side / 3)][rims.root(side_start(body_.triangles, side))];
      ++rim.edges;
      rim.length += length_at(side);
    }
    std::vector<char> is_wall(body_.triangles.size(), 0);
    for (const auto& [piece, its_rims] : rims_of) {
      if (area[piece] < kLeastOfBody * total_area_ || !are_pinholes(its_rims, area[piece])) {
        continue;
      }
      is_wall[piece] = 1;
      for (const auto& [root, rim] : its_rims) rims_.push_back(rim);
    }
    for (std::uint32_t t = 0; t < inner.size(); ++t) {
      if (inner[t] != 0) inner[t] = is_wall[pieces.root(t)];
    }
  }

  [[nodiscard]] bool are_pinholes(const std::map<std::uint32_t, PinholeRim>& rims,
                                  double wall) const {
    double area = 0;
    std::size_t narrow = 0, of_some_edges = 0;
    for (const auto& [root, rim] : rims) {
      area += rim.area();
      const double width = rim.width() / diagonal_;
      const bool is_of_mesh =
          rim.length >= kShortestEdge * mean_edge_ * static_cast<double>(rim.edges);
      const bool has_few = is_of_mesh && rim.edges <= kFewEdges && width <= kWidestOfFewEdges;
      narrow += width <= kNarrowPinhole || has_few ? 1 : 0;
      of_some_edges += is_of_mesh && rim.edges <= kSomeEdges ? 1 : 0;
    }
    const auto count = static_cast<double>(rims.size());
    const bool are_many = narrow >= kMany && static_cast<double>(narrow) >= kMostAreNarrow * count;
    if (area > (are_many ? 2 : 1) * kMostOfWall * wall) return false;
    return narrow == rims.size() || (are_many && of_some_edges == rims.size());
  }

  // From the rims of the inner wall on, what is no part of the outer one: seen along its normal it
  // is far thicker than a wall.
  void drop_tubes(std::vector<char>& inner) const {
    std::vector<std::uint32_t> across(3 * body_.triangles.size(), ~std::uint32_t{0}), waiting;
    sides_->for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() != 2) return;
      across[sides[0]] = sides[1] / 3;
      across[sides[1]] = sides[0] / 3;
    });
    for (std::uint32_t t = 0; t < inner.size(); ++t) {
      if (inner[t] != 0) waiting.push_back(t);
    }
    std::vector<char> is_looked_at = inner;
    while (!waiting.empty()) {
      const std::uint32_t t = waiting.back();
      waiting.pop_back();
      for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
        const std::uint32_t next = across[side];
        if (next == ~std::uint32_t{0} || is_looked_at[next] != 0) continue;
        is_looked_at[next] = 1;
        const double most = kTube * thickness_;
        if (std::isfinite(rays_->first_hit(next, -normal(next), most).distance)) continue;
        inner[next] = 1;
        waiting.push_back(next);
      }
    }
  }

  const TriangleSoup& body_;
  double diagonal_ = 0, total_area_ = 0, mean_edge_ = 0, thickness_ = 0;
  std::vector<double> area_;  // of each triangle
  std::optional<TriangleRays> rays_;
  std::optional<EdgeTable> sides_;
  std::vector<Sample> samples_;
  std::vector<PinholeRim> rims_;  // of the inner wall
};

// The parts that may have two walls, each a group.
MeshParts thin_parts(const TriangleSoup& mesh, const UnitScale& scale) {
  MeshParts parts = find_parts(mesh);
  std::vector<std::size_t> counts(parts.count, 0);
  std::vector<Box> boxes(parts.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t part = parts.of_triangle[t];
    ++counts[part];
    for (const std::uint32_t p : mesh.triangles[t]) boxes[part].add(scale(mesh.points[p]));
  }
  const std::vector<PartSize> sizes =
      part_sizes(mesh.points, mesh.triangles, parts.of_triangle, parts.count, scale);
  std::vector<std::uint32_t> group(parts.count, kNoGroup);
  std::uint32_t groups = 0;
  for (std::uint32_t part = 0; part < parts.count; ++part) {
    const double thickness = 2 * sizes[part].volume / sizes[part].area;
    const bool is_thin = thickness <= kThickestOnAverage * boxes[part].diagonal();
    if (counts[part] >= kFewestTriangles && sizes[part].volume > 0 && is_thin) {
      group[part] = groups++;
    }
  }
  for (std::uint32_t& part : parts.of_triangle) part = group[part];
  parts.count = groups;
  return parts;
}

}  // namespace

DoubleWalls find_double_walls(const Surface& solid, ProgressObserver* progress) {
  DoubleWalls found;
  const UnitScale scale(solid.mesh.points);
  const MeshParts parts = thin_parts(solid.mesh, scale);
  if (parts.count == 0) return found;
  std::vector<Surface> bodies = divide_surface(solid, parts);
  found.is_inner.assign(solid.mesh.triangles.size(), 0);
  std::vector<std::vector<char>> inner(parts.count);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (progress != nullptr && progress->cancelled()) throw Cancelled();
    for (Vec3d& p : bodies[b].mesh.points) p = scale(p);
    BodyWalls walls(bodies[b].mesh);
    inner[b] = walls.run();
    if (inner[b].empty()) continue;
    ++found.bodies;
    found.pinholes += walls.pinholes().size();
    for (const PinholeRim& rim : walls.pinholes()) {
      found.widest = std::max(found.widest, scale.back(rim.width()));
    }
  }
  // The triangles of a body are in their order.
  std::vector<std::size_t> next(parts.count, 0);
  for (std::size_t t = 0; t < parts.of_triangle.size(); ++t) {
    const std::uint32_t b = parts.of_triangle[t];
    if (b == kNoGroup || inner[b].empty()) continue;
    found.is_inner[t] = inner[b][next[b]++];
  }
  return found;
}

}  // namespace meshrepair::internal
