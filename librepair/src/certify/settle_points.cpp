// SPDX-License-Identifier: MIT
#include "settle_points.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <base/internal/hash_index.h>
#include <exact/double_predicates.h>
#include <mesh/precision.h>
#include <mesh/weld_points.h>

#include "point_mover.h"

namespace meshrepair::internal {
namespace {

class Settler {
 public:
  Settler(Surface& surface, const Grid& grid, KnownIntersections& known)
      : surface_(surface), grid_(grid), known_(known) {}

  std::size_t run() {
    const TriangleSoup& mesh = surface_.mesh;
    SelfIntersections found = known_.find(mesh);
    if (found.pairs.empty()) return 0;
    places_ = find_places(mesh.points);
    moves_.assign(places_.place.size(), 0);
    while (settle(found)) found = known_.find(mesh);
    return moved_;
  }

 private:
  // False if no point had to move.
  bool settle(const SelfIntersections& found) {
    std::fill(moves_.begin(), moves_.end(), 0);
    for (const auto& pair : found.pairs) {
      for (const std::uint32_t t : pair) {
        for (const std::uint32_t p : surface_.mesh.triangles[t]) moves_[places_.place[p]] = 1;
      }
    }
    const std::size_t before = moved_;
    for (std::size_t p = 0; p < surface_.mesh.points.size(); ++p) {
      if (moves_[places_.place[p]] != 0 && surface_.input_point[p] != 0) settle_point(p);
    }
    return moved_ > before;
  }

  void settle_point(std::size_t p) {
    Vec3d& position = surface_.mesh.points[p];
    const Vec3d on_grid = as_vector(grid_.to_grid(position));
    const Vec3d settled = grid_.from_grid({on_grid.x(), on_grid.y(), on_grid.z()});
    if (settled == position) return;
    position = settled;
    surface_.input_point[p] = 0;
    ++moved_;
  }

  Surface& surface_;
  const Grid& grid_;
  KnownIntersections& known_;
  PointPlaces places_;
  std::vector<char> moves_;  // of each place
  std::size_t moved_ = 0;
};

}  // namespace

std::size_t settle_input_points(Surface& surface, const Grid& grid, KnownIntersections& known) {
  return Settler(surface, grid, known).run();
}

namespace {

constexpr std::uint32_t kTries = 24;
// How many steps all tries together may move a point by.
constexpr double kSettleReach = 256;
// Beyond this there are too many faults for chance to be a remedy.
constexpr std::size_t kMostTriangles = 20'000;

// By a few of the smallest steps that can be written, more in later tries.
Vec3d moved_by_chance(const Vec3d& from, std::size_t i, std::uint32_t attempt,
                      Precision precision) {
  Vec3d to = from;
  const std::int64_t reach = std::int64_t{1} << (attempt / 4);
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint64_t chance =
        hash_mix(hash_mix(i + 1, attempt), static_cast<std::uint64_t>(axis));
    const std::int64_t steps =
        static_cast<std::int64_t>((chance >> 20) % static_cast<std::uint64_t>(2 * reach + 1)) -
        reach;
    to[axis] += static_cast<double>(steps) * number_spacing(from.cwiseAbs().maxCoeff(), precision);
  }
  return rounded_to(to, precision);
}

// Corners of the triangles that are no points of the input.
std::vector<std::uint32_t> find_movable(const Surface& surface,
                                        const std::vector<std::uint32_t>& triangles) {
  std::vector<char> known(surface.mesh.points.size(), 0);
  std::vector<std::uint32_t> movable;
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t p : surface.mesh.triangles[t]) {
      if (surface.input_point[p] != 0 || known[p] != 0) continue;
      known[p] = 1;
      movable.push_back(p);
    }
  }
  return movable;
}

std::vector<std::uint32_t> triangles_at_fault(const TriangleSoup& mesh,
                                              const SelfIntersections& found) {
  std::vector<std::uint32_t> triangles;
  for (const auto& pair : found.pairs) {
    triangles.insert(triangles.end(), pair.begin(), pair.end());
  }
  if (found.degenerate > 0) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& c = mesh.triangles[t];
      if (projection_axis(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]) < 0) {
        triangles.push_back(t);
      }
    }
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace

void nudge_points(Surface& surface, const SelfIntersections& found, Precision precision,
                  ProgressObserver* progress) {
  TriangleSoup& mesh = surface.mesh;
  const std::vector<std::uint32_t> at_fault = triangles_at_fault(mesh, found);
  if (at_fault.size() > kMostTriangles) return;
  const std::vector<std::uint32_t> movable = find_movable(surface, at_fault);
  if (movable.empty()) return;
  std::vector<std::uint32_t> each(movable.size());
  std::iota(each.begin(), each.end(), 0u);
  const double reach = kSettleReach * number_spacing(mesh, precision);
  PointMover mover(mesh, movable, std::move(each), reach, progress);
  for (std::uint32_t k = 0; k < kTries && mover.faults() > 0; ++k) {
    mover.try_moves(
        [&](std::size_t i) { return moved_by_chance(mesh.points[movable[i]], i, k, precision); });
  }
}

}  // namespace meshrepair::internal
