#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>
#include <check/soup_rays.h>
#include <repair/orient_parts.h>
#include <repair/seal_openings.h>

#include "ball_reach.h"
#include "holes/new_points.h"
#include "seal_patch.h"
#include "space_grid.h"

namespace meshrepair {
namespace {

using internal::BallReach;
using internal::SealPatch;
using internal::SpaceGrid;

// Of the grid across the ball's diameter. More than some only where that takes few cubes.
constexpr double kFewestSteps = 6, kSomeSteps = 12, kMostSteps = 96;
constexpr double kMargin = 2;  // steps beyond the radius in which distances are known

// In grid coordinates.
TriangleSoup on_grid(const CleanSoup& soup) {
  TriangleSoup triangles;
  triangles.points.reserve(soup.grid_points.size());
  for (const GridPoint& p : soup.grid_points) triangles.points.push_back(as_vector(p));
  triangles.triangles = index_triangles(soup);
  return triangles;
}

// Of the bounding box.
Vec3d extent_of(const TriangleSoup& soup) {
  Vec3d low = soup.points.front(), high = low;
  for (const Vec3d& p : soup.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high - low;
}

[[noreturn]] void refuse_size(double size) {
  throw UsageError("openings of " + std::to_string(size) +
                   " are too small for this mesh to be found: give a larger size to seal");
}

// With as many steps across the ball as there may be cubes.
SpaceGrid make_grid(const TriangleSoup& soup, double size, double unit, std::size_t most_cubes,
                    ProgressObserver* progress) {
  const auto with_steps = [&](double steps) {
    const double step = size / steps;
    return SpaceGrid(soup, step, size / 2 + kMargin * step, progress);
  };
  const Vec3d bricks = extent_of(soup) / (SpaceGrid::kBrick * size / kFewestSteps);
  if ((bricks.array() + 8).prod() > static_cast<double>(most_cubes)) refuse_size(size * unit);
  double steps = kFewestSteps;
  SpaceGrid grid = with_steps(steps);
  if (grid.cubes() > most_cubes) refuse_size(size * unit);
  // Twice as many steps make up to eight times the cubes.
  while (steps < kMostSteps) {
    const std::size_t most = 2 * steps <= kSomeSteps ? most_cubes : most_cubes / 8;
    if (grid.cubes() > most / 4) break;
    steps *= 2;
    SpaceGrid finer = with_steps(steps);
    if (finer.cubes() > most) break;
    grid = std::move(finer);
  }
  return grid;
}

void add_triangle(CleanSoup& soup, const std::array<PointId, 3>& corners) {
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
  const auto& at = soup.grid_points;
  Plane plane = plane_through(at[corners[0]], at[corners[1]], at[corners[2]]);
  if (is_null(plane)) return;
  soup.triangles.push_back({corners, soup.planes.intern(plane).id, 0, Triangle::kNoSource});
}

void add_patch(CleanSoup& soup, const SealPatch& patch) {
  internal::NewPoints new_points(soup);
  std::vector<PointId> ids;
  ids.reserve(patch.soup.points.size());
  for (const Vec3d& p : patch.soup.points) ids.push_back(new_points.add(p));
  for (const auto& t : patch.soup.triangles) add_triangle(soup, {ids[t[0]], ids[t[1]], ids[t[2]]});
}

}  // namespace

void seal_openings(CleanSoup& soup, const SealOptions& options, SealReport& report,
                   ProgressObserver* progress) {
  report = {};
  if (options.size <= 0 || soup.triangles.empty()) return;
  const TriangleSoup triangles = on_grid(soup);
  const double diagonal = extent_of(triangles).norm();
  const double asked = options.is_share ? options.size * diagonal : options.size / soup.grid.unit;
  report.size = asked * soup.grid.unit;
  // A ball that is larger rolls around the whole hardly otherwise.
  const double size = std::min(asked, diagonal);
  SpaceGrid grid = make_grid(triangles, size, soup.grid.unit, options.most_cubes, progress);
  report.step = grid.step() * soup.grid.unit;
  grid.measure(progress);
  const std::vector<std::int32_t> no_winding(triangles.triangles.size(), 0);
  const SoupRays rays(triangles, no_winding);
  BallReach reach(grid, rays, size / 2);
  if (!reach.find(progress)) return;
  const std::size_t before = soup.triangles.size();
  const SealPatch patch = make_seal_patch(grid, rays, reach.closed_faces(progress));
  add_patch(soup, patch);
  report.openings = patch.pieces;
  report.triangles = soup.triangles.size() - before;
}

}  // namespace meshrepair
