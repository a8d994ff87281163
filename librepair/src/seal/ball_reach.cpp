// SPDX-License-Identifier: MIT
#include "ball_reach.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

namespace meshrepair::internal {
namespace {

constexpr float kNoDepth = std::numeric_limits<float>::infinity();

// In steps of the grid: how much farther than the ball's radius a centre may be from what the ball
// touches, as centres are in places of the grid alone.
constexpr double kCentreRounding = 1;
// Of so many cubes along each axis one is asked whether the ball gets from it to what is beside: a
// ball is twice as wide.
constexpr std::int32_t kAsked = 3;
// In steps of the grid: how much nearer to walls a centre may be than the radius. The middle of a
// cube is up to 0.87 steps away from a centre in it: so a ball that is half a step smaller passes
// surely, and one that is so much larger surely does not.
constexpr double kSlack = 0.37;
// In steps of the grid: less deep is nothing that the grid could tell from a fillet.
constexpr double kLeastDepth = 3;
// A deep place is farther in than this share of what it is from its walls.
constexpr double kDeep = 0.3;
// And no place around it, so many steps away, is farther from all walls by more than this share of
// the way: in a wedge of 60 degrees some are by a half, in a corner of three right angles by 0.58.
// Places are up to 9 degrees beside the best way: so it is 0.36 at least in a wedge of 60 degrees.
constexpr std::int32_t kShell = 3;
constexpr double kWidening = 0.35;
// What is deeper by more than this share of the way is farther in.
constexpr double kInward = 0.5;
// In radii of the ball: nobody asks how deep it is there.
constexpr double kFarthestDepth = 4;
// In steps of the grid: how far behind what the ball reaches a way is closed off. There walls are
// beside the way, not across it.
constexpr double kBehind = 2;

using CubeEntry = std::pair<float, std::uint32_t>;
using CubeQueue = std::priority_queue<CubeEntry, std::vector<CubeEntry>, std::greater<>>;

}  // namespace

bool BallReach::is_open(std::uint32_t node) const {
  return grid_.clearance(node) >= radius_ - kSlack * grid_.step();
}

bool BallReach::is_free(std::uint32_t a, std::uint32_t b) const {
  return is_free_way(grid_, rays_, a, b);
}

template <class Visit>
void BallReach::visit_around(std::uint32_t cube, Visit visit) const {
  const CubePlace at = grid_.place_of(cube);
  for (std::int32_t z = -1; z <= 1; ++z) {
    for (std::int32_t y = -1; y <= 1; ++y) {
      for (std::int32_t x = -1; x <= 1; ++x) {
        const int axes = x * x + y * y + z * z;
        if (axes == 0) continue;
        const std::uint32_t next = grid_.node_at({at[0] + x, at[1] + y, at[2] + z});
        if (next == kNone || !grid_.is_cube(next)) continue;
        visit(next, std::sqrt(static_cast<double>(axes)) * grid_.step());
      }
    }
  }
}

// Whether the ball gets from a place straight to where the larger one is that comes to another
// place, as far as samples tell.
bool BallReach::gets_to_larger(const Vec3d& from, const Vec3d& place,
                               const NearestTriangle& nearest) const {
  const std::uint32_t there = larger_->grid_.node_around(place);
  return there != kNone && larger_->reached_[there] != 0 &&
         gets_straight(from, larger_->grid_.centre(larger_->centre_of_[there]), nearest);
}

// The middle of the larger grid's cube around a place may be behind a wall, or what comes to it.
bool BallReach::gets_beside(const Vec3d& from, const NearestTriangle& nearest) const {
  for (int k = 0; k < 27; ++k) {
    const int row = k / 3, layer = k / 9;
    const Vec3d beside(k % 3 - 1, row % 3 - 1, layer - 1);
    if (gets_to_larger(from, from + larger_->grid_.step() * beside, nearest)) return true;
  }
  return false;
}

// To a centre of the larger ball, within which there is room anyway.
bool BallReach::gets_straight(const Vec3d& from, const Vec3d& to,
                              const NearestTriangle& nearest) const {
  const double length = (to - from).norm();
  const double narrow = length - (larger_->radius_ - radius_);
  const double least = radius_ - kSlack * grid_.step();
  std::uint32_t hint = 0;
  for (double at = 0; at < narrow;) {
    const Nearest found = nearest.find(from + at / length * (to - from), hint);
    const double room = std::sqrt(found.squared_distance) - least;
    if (room < 0) return false;
    at += std::max(grid_.step(), room);
    hint = found.triangle;
  }
  return true;
}

void BallReach::put_centres(ProgressObserver* progress) {
  reached_.assign(grid_.nodes(), 0);
  if (larger_ == nullptr) {
    spread_from(grid_.outermost(), progress);
    return;
  }
  const NearestTriangle nearest(grid_.corners());
  CancelCheck check(progress);
  for (const bool beside : {false, true}) {
    for (std::uint32_t c = 0; c < grid_.cubes(); ++c) {
      check.tick();
      if (reached_[c] != 0 || !is_open(c) || (beside && !is_asked(c))) continue;
      const Vec3d at = grid_.centre(c);
      if (beside ? gets_beside(at, nearest) : gets_to_larger(at, at, nearest)) {
        spread_from(c, progress);
      }
    }
  }
}

bool BallReach::is_asked(std::uint32_t cube) const {
  const CubePlace at = grid_.place_of(cube);
  return std::all_of(at.begin(), at.end(), [](std::int32_t x) { return x % kAsked == 0; });
}

void BallReach::spread_from(std::uint32_t first, ProgressObserver* progress) {
  CancelCheck check(progress);
  std::vector<std::uint32_t> waiting = {first};
  reached_[first] = 2;
  while (!waiting.empty()) {
    check.tick();
    const std::uint32_t node = waiting.back();
    waiting.pop_back();
    grid_.visit_neighbours(node, [&](std::uint32_t next) {
      if (reached_[next] != 0 || !is_open(next)) return;
      reached_[next] = 2;
      waiting.push_back(next);
    });
  }
}

// Each cube from the nearest centre.
void BallReach::roll(ProgressObserver* progress) {
  using Rolled = std::tuple<float, std::uint32_t, std::uint32_t>;  // distance, cube, centre
  std::priority_queue<Rolled, std::vector<Rolled>, std::greater<>> queue;
  const double most = radius_ + kCentreRounding * grid_.step();
  const auto push_around = [&](std::uint32_t cube, std::uint32_t from) {
    grid_.visit_neighbours(cube, [&](std::uint32_t next) {
      if (!grid_.is_cube(next) || reached_[next] != 0) return;
      const double distance = (grid_.centre(next) - grid_.centre(from)).norm();
      if (distance > most || !is_free(cube, next)) return;
      queue.emplace(static_cast<float>(distance), next, from);
    });
  };
  centre_of_.resize(grid_.nodes());
  std::iota(centre_of_.begin(), centre_of_.end(), 0u);
  CancelCheck check(progress);
  for (std::uint32_t c = 0; c < grid_.cubes(); ++c) {
    check.tick();
    if (reached_[c] == 2) push_around(c, c);
  }
  while (!queue.empty()) {
    const auto [distance, cube, from] = queue.top();
    queue.pop();
    check.tick();
    if (reached_[cube] != 0) continue;
    reached_[cube] = 1;
    centre_of_[cube] = from;
    push_around(cube, from);
  }
}

// Ways are straight where nothing is between, so they begin where they really do (Theta*: Nash,
// Daniel, Koenig and Felner 2007). Returns the cubes that have a depth, the least deep first.
std::vector<std::uint32_t> BallReach::find_depths(ProgressObserver* progress) {
  std::vector<std::uint32_t> order;
  depth_.assign(grid_.cubes(), kNoDepth);
  std::vector<std::uint32_t> from(grid_.cubes(), kNone);  // the corner before
  CubeQueue queue;
  const auto go_to = [&](std::uint32_t next, std::uint32_t corner) {
    const double before = reached_[corner] != 0 ? 0 : static_cast<double>(depth_[corner]);
    const auto there =
        static_cast<float>(before + (grid_.centre(next) - grid_.centre(corner)).norm());
    if (there >= depth_[next]) return true;
    if (!is_free(corner, next)) return false;
    depth_[next] = there;
    from[next] = corner;
    queue.emplace(there, next);
    return true;
  };
  const auto go_on = [&](std::uint32_t cube, std::uint32_t corner) {
    visit_around(cube, [&](std::uint32_t next, double) {
      if (reached_[next] == 0 && !go_to(next, corner)) (void)go_to(next, cube);
    });
  };
  CancelCheck check(progress);
  for (std::uint32_t c = 0; c < grid_.cubes(); ++c) {
    check.tick();
    if (reached_[c] != 0) go_on(c, c);
  }
  while (!queue.empty()) {
    const auto [depth, cube] = queue.top();
    queue.pop();
    check.tick();
    if (depth > depth_[cube]) continue;
    order.push_back(cube);
    if (static_cast<double>(depth) < kFarthestDepth * radius_) go_on(cube, from[cube]);
  }
  return order;
}

// All that is as deep as a deep cube and connected with it.
bool BallReach::find_deep(const std::vector<std::uint32_t>& by_depth, ProgressObserver* progress) {
  CancelCheck check(progress);
  std::vector<char> is_found(grid_.cubes(), 0);
  for (const std::uint32_t seed : by_depth) {
    check.tick();
    if (is_found[seed] != 0 || !is_deep(seed)) continue;
    is_found[seed] = 1;
    deep_.push_back(seed);
    for (std::size_t i = deep_.size() - 1; i < deep_.size(); ++i) {
      const std::uint32_t cube = deep_[i];
      check.tick();
      visit_around(cube, [&](std::uint32_t next, double) {
        const bool is_as_deep = depth_[next] < kNoDepth && depth_[next] >= depth_[seed];
        if (is_found[next] != 0 || !is_as_deep || !is_free(cube, next)) return;
        is_found[next] = 1;
        deep_.push_back(next);
      });
    }
  }
  return !deep_.empty();
}

bool BallReach::is_deep(std::uint32_t cube) const {
  const double least = std::max(kLeastDepth * grid_.step(), kDeep * grid_.clearance(cube));
  return static_cast<double>(depth_[cube]) > least && grid_.is_amid(cube) && !widens(cube);
}

// Walls are farther away elsewhere around, by much, and not because it is farther in.
bool BallReach::widens(std::uint32_t cube) const {
  const CubePlace at = grid_.place_of(cube);
  const double here = grid_.clearance(cube);
  CubePlace by{};
  for (by[2] = -kShell; by[2] <= kShell; ++by[2]) {
    for (by[1] = -kShell; by[1] <= kShell; ++by[1]) {
      const bool is_side = std::max(std::abs(by[1]), std::abs(by[2])) == kShell;
      for (by[0] = -kShell; by[0] <= kShell; by[0] += is_side ? 1 : 2 * kShell) {
        const std::uint32_t next = grid_.node_at({at[0] + by[0], at[1] + by[1], at[2] + by[2]});
        if (next == kNone || !grid_.is_cube(next)) continue;
        const double way = (grid_.centre(next) - grid_.centre(cube)).norm();
        if (grid_.clearance(next) <= here + kWidening * way) continue;
        const double inward =
            reached_[next] != 0 ? -way : static_cast<double>(depth_[next] - depth_[cube]);
        if (inward <= kInward * way && is_free(cube, next)) return true;
      }
    }
  }
  return false;
}

// From what is deep as far towards the ball as that is behind it.
void BallReach::grow_back(ProgressObserver* progress) {
  back_.assign(grid_.cubes(), kNoDepth);
  CubeQueue queue;
  for (const std::uint32_t cube : deep_) {
    back_[cube] = -depth_[cube];
    queue.emplace(back_[cube], cube);
  }
  const double most = kCentreRounding * grid_.step();
  CancelCheck check(progress);
  while (!queue.empty()) {
    const float distance = queue.top().first;
    const std::uint32_t cube = queue.top().second;
    queue.pop();
    check.tick();
    if (distance > back_[cube]) continue;
    visit_around(cube, [&](std::uint32_t next, double step) {
      const auto there = static_cast<float>(static_cast<double>(distance) + step);
      const bool is_shallow = reached_[next] == 0 && depth_[next] < kNoDepth;
      if (!is_shallow || there >= back_[next] || static_cast<double>(there) > most) return;
      if (!is_free(cube, next)) return;
      back_[next] = there;
      queue.emplace(there, next);
    });
  }
}

void BallReach::roll_around(ProgressObserver* progress) {
  put_centres(progress);
  roll(progress);
}

bool BallReach::find(ProgressObserver* progress) {
  roll_around(progress);
  if (!find_deep(find_depths(progress), progress)) return false;
  grow_back(progress);
  return true;
}

bool BallReach::is_behind(std::uint32_t cube) const {
  return reached_[cube] == 0 && back_[cube] < kNoDepth &&
         static_cast<double>(depth_[cube]) >= kBehind * grid_.step();
}

std::vector<BallReach::Face> BallReach::closed_faces(ProgressObserver* progress) const {
  std::vector<Face> faces;
  CancelCheck check(progress);
  for (std::uint32_t c = 0; c < grid_.cubes(); ++c) {
    check.tick();
    if (!is_behind(c)) continue;
    grid_.visit_neighbours(c, [&](std::uint32_t next) {
      if (!grid_.is_cube(next) || is_behind(next)) return;
      // What was not reached from where the ball comes to lies deeper, or behind walls.
      const bool is_before = reached_[next] != 0 || depth_[next] < kNoDepth;
      if (is_before && is_free(c, next)) faces.push_back({next, c});
    });
  }
  return faces;
}

}  // namespace meshrepair::internal
