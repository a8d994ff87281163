// SPDX-License-Identifier: MIT
#include "openings.h"

#include <algorithm>

namespace meshrepair::internal {
namespace {

// Of the grid across the ball's diameter. More than some only where that takes few cubes.
constexpr double kLeastSteps = 6, kSomeSteps = 12, kMostSteps = 48;
constexpr double kMargin = 2;  // steps beyond the radius in which distances are known

// All space is looked at with up to this share of the cubes that there may be.
constexpr std::size_t kShareOfWhole = 8;

// Places of cubes are numbers of 21 bits.
constexpr double kMostCubesAside = 1 << 20;

// Cubes that a square has that is as large as the mesh, where only a larger ball is looked at.
constexpr double kCoarseCubes = 1 << 14;

// What is done, of the whole time.
constexpr double kLaidOut = 0.3, kMeasured = 0.5, kRolled = 0.9;

}  // namespace

Openings::Found Openings::find(double size) {
  larger_.reset();
  grid_ = whole_grid(size);
  if (!grid_) {
    grid_ = narrow_grid(size);
    if (!grid_) return Found::too_many_cubes;
    if (grid_->cubes() == 0) return Found::none;
    roll_larger_ball(size);
  }
  advance(kLaidOut);
  grid_->measure(progress_);
  advance(kMeasured);
  reach_.emplace(*grid_, rays_, size / 2, larger_ ? &*larger_ : nullptr);
  if (!reach_->find(progress_)) return Found::none;
  advance(kRolled);
  closed_ = reach_->closed_faces(progress_);
  return closed_.empty() ? Found::none : Found::some;
}

void Openings::advance(double share) const {
  if (progress_ != nullptr) progress_->advance(share);
}

// With as many steps across the ball as there may be cubes; nothing if these are too few.
std::optional<SpaceGrid> Openings::whole_grid(double size) const {
  const auto with_steps = [&](double steps) {
    const double step = size / steps;
    return SpaceGrid(mesh_, step, size / 2 + kMargin * step, progress_);
  };
  const std::size_t most = most_cubes_ / kShareOfWhole;
  const Vec3d bricks = extent_ / (SpaceGrid::kBrick * size / kSomeSteps);
  if ((bricks.array() + 8).prod() > static_cast<double>(most)) return std::nullopt;
  double steps = kSomeSteps;
  SpaceGrid grid = with_steps(steps);
  if (grid.cubes() > most) return std::nullopt;
  // Twice as many steps make up to eight times the cubes.
  while (steps < kMostSteps && grid.cubes() <= most / 4 / bodies_) {
    steps *= 2;
    SpaceGrid finer = with_steps(steps);
    if (finer.cubes() > most / 2 / bodies_) break;
    grid = std::move(finer);
  }
  return grid;
}

std::optional<SpaceGrid> Openings::narrow_grid(double size) const {
  std::optional<SpaceGrid> grid;
  for (const double steps : {kSomeSteps, kLeastSteps}) {
    const double step = size / steps;
    if (extent_.maxCoeff() > kMostCubesAside * step) break;
    grid = SpaceGrid::of_narrow_places(mesh_, step, size / 2 + kMargin * step, size, most_cubes_,
                                       progress_);
    if (grid) break;
  }
  return grid;
}

// The smallest one that is cheap.
void Openings::roll_larger_ball(double size) {
  double step = 2 * size / kLeastSteps;
  const double longest = extent_.maxCoeff();
  while ((longest / step) * (longest / step) > kCoarseCubes) step *= 2;
  const double radius = step * kLeastSteps / 2;
  coarse_.emplace(mesh_, step, radius + kMargin * step, progress_);
  coarse_->measure(progress_);
  larger_.emplace(*coarse_, rays_, radius);
  larger_->roll_around(progress_);
}

Vec3d half_extent_of(const TriangleSoup& soup) {
  Vec3d low = soup.points.front(), high = low;
  for (const Vec3d& p : soup.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high / 2 - low / 2;
}

}  // namespace meshrepair::internal
