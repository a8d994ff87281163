// SPDX-License-Identifier: MIT
#include "space_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include <base/parallel.h>
#include <check/box_tree.h>
#include <check/internal/nearest_triangle.h>

#include "narrow_places.h"

namespace meshrepair::internal {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::infinity();

// So far from a triangle, in steps, the distance is exact.
constexpr double kExact = 1.5;

// Some milliseconds of work.
constexpr std::size_t kBricksPerTask = 16;

Corners corners_of(const TriangleSoup& soup, std::uint32_t t) {
  const auto& c = soup.triangles[t];
  return {soup.points[c[0]], soup.points[c[1]], soup.points[c[2]]};
}

}  // namespace

SpaceGrid::SpaceGrid(const TriangleSoup& soup, double step, double reach)
    : soup_(&soup), step_(step), reach_(reach) {
  Box box;
  for (const auto& triangle : soup.triangles) {
    for (const std::uint32_t p : triangle) box.add(soup.points[p]);
  }
  // Two bricks around the reach: nothing is near the outermost one.
  const double margin = reach + 2 * kBrick * step;
  for (std::size_t k = 0; k < 3; ++k) {
    low_[static_cast<Eigen::Index>(k)] = box.low[k] - margin;
    size_[k] = static_cast<std::int32_t>(
        std::ceil((box.high[k] - box.low[k] + 2 * margin) / (kBrick * step)));
  }
}

SpaceGrid::SpaceGrid(const TriangleSoup& soup, double step, double reach,
                     ProgressObserver* progress)
    : SpaceGrid(soup, step, reach) {
  std::size_t count = 1;
  for (const std::int32_t size : size_) count *= static_cast<std::size_t>(size);
  bricks_.assign(count, kNone);
  find_refined(progress);
}

std::optional<SpaceGrid> SpaceGrid::of_narrow_places(const TriangleSoup& soup, double step,
                                                     double reach, double width,
                                                     std::size_t most_cubes,
                                                     ProgressObserver* progress) {
  SpaceGrid grid(soup, step, reach);
  const NarrowPlaces narrow(soup, grid.low_, kBrick * step, width, progress);
  const std::optional<std::vector<CubePlace>> bricks = narrow.find(grid.size_, most_cubes / kCubes);
  if (!bricks) return std::nullopt;
  grid.refine_around(*bricks);
  if (grid.cubes() > most_cubes) return std::nullopt;
  return grid;
}

void SpaceGrid::refine_around(const std::vector<Brick>& narrow) {
  for (const Brick& brick : narrow) {
    for (std::int32_t i = 0; i < 27; ++i) {
      const Brick at = {brick[0] + i % 3 - 1, brick[1] + i / 3 % 3 - 1, brick[2] + i / 9 - 1};
      bool is_there = true;
      for (std::size_t k = 0; k < 3; ++k) is_there = is_there && at[k] >= 0 && at[k] < size_[k];
      if (is_there) refined_.push_back(number_of(at));
    }
  }
  std::sort(refined_.begin(), refined_.end());
  refined_.erase(std::unique(refined_.begin(), refined_.end()), refined_.end());
  refined_of_ = HashIndex(refined_.size());
  for (std::uint32_t b = 0; b < refined_.size(); ++b) {
    (void)refined_of_.find_or_insert(hash_mix(0, refined_[b]), b,
                                     [](std::uint32_t) { return false; });
  }
  is_narrow_.assign(refined_.size(), 0);
  for (const Brick& brick : narrow) is_narrow_[refined_at(number_of(brick))] = 1;
}

std::uint32_t SpaceGrid::refined_at(std::uint64_t number) const {
  if (is_whole()) return bricks_[static_cast<std::size_t>(number)];
  return refined_of_.find(hash_mix(0, number),
                          [&](std::uint32_t b) { return refined_[b] == number; });
}

std::uint64_t SpaceGrid::number_of(const Brick& brick) const {
  std::uint64_t number = 0;
  for (std::size_t k = 3; k-- > 0;) {
    number = number * static_cast<std::uint64_t>(size_[k]) + static_cast<std::uint64_t>(brick[k]);
  }
  return number;
}

SpaceGrid::Brick SpaceGrid::brick_of(std::uint64_t number) const {
  Brick brick{};
  for (std::size_t k = 0; k < 3; ++k) {
    brick[k] = static_cast<std::int32_t>(number % static_cast<std::uint64_t>(size_[k]));
    number /= static_cast<std::uint64_t>(size_[k]);
  }
  return brick;
}

std::uint32_t SpaceGrid::node_at(const CubePlace& place) const {
  Brick brick{};
  std::uint32_t cube = 0;
  for (std::size_t k = 3; k-- > 0;) {
    if (place[k] < 0 || place[k] >= kBrick * size_[k]) return kNone;
    brick[k] = place[k] / kBrick;
    cube = cube * kBrick + static_cast<std::uint32_t>(place[k] % kBrick);
  }
  const std::uint64_t number = number_of(brick);
  const std::uint32_t refined = refined_at(number);
  if (refined != kNone) return kCubes * refined + cube;
  return is_whole() ? static_cast<std::uint32_t>(cubes() + number) : kNone;
}

std::uint32_t SpaceGrid::node_around(const Vec3d& point) const {
  CubePlace place{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    place[k] = static_cast<std::int32_t>(std::floor((point[axis] - low_[axis]) / step_));
  }
  return node_at(place);
}

CubePlace SpaceGrid::place_of(std::uint32_t cube) const {
  const Brick brick = brick_of(refined_[cube / kCubes]);
  std::uint32_t within = cube % kCubes;
  CubePlace place{};
  for (std::size_t k = 0; k < 3; ++k) {
    place[k] = kBrick * brick[k] + static_cast<std::int32_t>(within % kBrick);
    within /= kBrick;
  }
  return place;
}

Vec3d SpaceGrid::corner(const CubePlace& place) const {
  return low_ + step_ * Vec3d(place[0], place[1], place[2]);
}

Vec3d SpaceGrid::centre(std::uint32_t node) const {
  if (is_cube(node)) return corner(place_of(node)) + Vec3d::Constant(step_ / 2);
  const Brick brick = brick_of(node - cubes());
  return corner({kBrick * brick[0], kBrick * brick[1], kBrick * brick[2]}) +
         Vec3d::Constant(kBrick * step_ / 2);
}

double SpaceGrid::clearance(std::uint32_t node) const {
  return is_cube(node) ? std::sqrt(static_cast<double>(squared_[node]))
                       : std::numeric_limits<double>::infinity();
}

template <class Visit>
void SpaceGrid::descend(std::uint32_t triangle, const CubePlace& low, std::int32_t side,
                        double reach, std::int32_t smallest, Visit& visit) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (low[k] + side <= 0 || low[k] >= kBrick * size_[k]) return;
  }
  const Vec3d middle = corner(low) + Vec3d::Constant(side * step_ / 2);
  const double around = side * step_ / 2 * std::numbers::sqrt3 + reach;
  if (squared_distance(middle, corners_of(*soup_, triangle)) > around * around) return;
  if (side == smallest) {
    visit(low);
    return;
  }
  const std::int32_t half = side / 2;
  for (int octant = 0; octant < 8; ++octant) {
    descend(triangle,
            {low[0] + half * (octant & 1), low[1] + half * (octant >> 1 & 1),
             low[2] + half * (octant >> 2)},
            half, reach, smallest, visit);
  }
}

// Cubes or bricks, as `smallest` says, from ones that are as large as what the triangle reaches.
template <class Visit>
void SpaceGrid::visit_near(std::uint32_t triangle, double reach, std::int32_t smallest,
                           Visit visit) const {
  Box box;
  for (const Vec3d& p : corners_of(*soup_, triangle)) box.add(p);
  box.widen(reach);
  CubePlace low{}, high{};
  std::int32_t side = smallest;
  for (std::size_t k = 0; k < 3; ++k) {
    const double from = low_[static_cast<Eigen::Index>(k)];
    low[k] = static_cast<std::int32_t>(std::floor((box.low[k] - from) / step_));
    high[k] = static_cast<std::int32_t>(std::floor((box.high[k] - from) / step_));
    while (side <= high[k] - low[k]) side *= 2;
  }
  for (std::int32_t z = low[2] / side; z <= high[2] / side; ++z) {
    for (std::int32_t y = low[1] / side; y <= high[1] / side; ++y) {
      for (std::int32_t x = low[0] / side; x <= high[0] / side; ++x) {
        descend(triangle, {side * x, side * y, side * z}, side, reach, smallest, visit);
      }
    }
  }
}

void SpaceGrid::find_refined(ProgressObserver* progress) {
  CancelCheck check(progress);
  for (std::uint32_t t = 0; t < soup_->triangles.size(); ++t) {
    check.tick();
    visit_near(t, reach_, kBrick, [&](const CubePlace& low) {
      bricks_[static_cast<std::size_t>(
          number_of({low[0] / kBrick, low[1] / kBrick, low[2] / kBrick}))] = 0;
    });
  }
  for (std::uint32_t b = 0; b < bricks_.size(); ++b) {
    if (bricks_[b] == kNone) continue;
    bricks_[b] = static_cast<std::uint32_t>(refined_.size());
    refined_.push_back(b);
  }
}

float SpaceGrid::squared_distance_to(std::uint32_t cube, std::uint32_t triangle) const {
  return static_cast<float>(squared_distance(centre(cube), corners_of(*soup_, triangle)));
}

void SpaceGrid::measure(ProgressObserver* progress) {
  squared_.assign(cubes(), kUnknown);
  nearest_.assign(cubes(), kNone);
  if (!is_whole()) {
    measure_all(progress);
    return;
  }
  CancelCheck check(progress);
  for (std::uint32_t t = 0; t < soup_->triangles.size(); ++t) {
    check.tick();
    visit_near(t, kExact * step_, 1, [&](const CubePlace& place) { measure_from(place, t); });
  }
  propagate(progress);
}

std::vector<Corners> SpaceGrid::corners() const {
  std::vector<Corners> triangles(soup_->triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) triangles[t] = corners_of(*soup_, t);
  return triangles;
}

// What is nearest to a cube may lie where no cubes are: so all triangles are asked.
void SpaceGrid::measure_all(ProgressObserver* progress) {
  const NearestTriangle nearest(corners());
  CancelCheck check(progress);
  parallel_tasks(
      refined_.size(), kBricksPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
        std::uint32_t hint = 0;
        for (std::size_t c = kCubes * first; c < kCubes * last; ++c) {
          const Nearest found = nearest.find(centre(static_cast<std::uint32_t>(c)), hint);
          squared_[c] = static_cast<float>(found.squared_distance);
          hint = found.triangle;
        }
      });
  check.ask();
}

void SpaceGrid::measure_from(const CubePlace& place, std::uint32_t triangle) {
  const std::uint32_t cube = node_at(place);
  const float squared = squared_distance_to(cube, triangle);
  if (squared >= squared_[cube]) return;
  squared_[cube] = squared;
  nearest_[cube] = triangle;
}

// From near to far, as Dijkstra's algorithm does.
void SpaceGrid::propagate(ProgressObserver* progress) {
  using MeasuredCube = std::pair<float, std::uint32_t>;
  std::priority_queue<MeasuredCube, std::vector<MeasuredCube>, std::greater<>> queue;
  for (std::uint32_t c = 0; c < squared_.size(); ++c) {
    if (nearest_[c] != kNone) queue.emplace(squared_[c], c);
  }
  CancelCheck check(progress);
  const auto farthest = static_cast<float>(reach_ * reach_);
  while (!queue.empty()) {
    const auto [squared, cube] = queue.top();
    queue.pop();
    check.tick();
    if (squared > squared_[cube] || squared > farthest) continue;
    const std::uint32_t triangle = nearest_[cube];
    visit_neighbours(cube, [&](std::uint32_t next) {
      if (!is_cube(next) || nearest_[next] == triangle) return;
      const float there = squared_distance_to(next, triangle);
      if (there >= squared_[next]) return;
      squared_[next] = there;
      nearest_[next] = triangle;
      queue.emplace(there, next);
    });
  }
}

bool is_free_way(const SpaceGrid& grid, const SoupRays& rays, std::uint32_t a, std::uint32_t b) {
  const Vec3d from = grid.centre(a), to = grid.centre(b);
  const double length = (to - from).norm();
  if (grid.clearance(a) > length || grid.clearance(b) > length) return true;
  return rays.sees(from, to);
}

}  // namespace meshrepair::internal
