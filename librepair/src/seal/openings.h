// SPDX-License-Identifier: MIT
// Where openings are that a ball of one size cannot pass.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <base/progress.h>
#include <check/soup_rays.h>
#include <mesh/soup.h>

#include "ball_reach.h"
#include "space_grid.h"

namespace meshrepair::internal {

// Of the bounding box of all points; there is one. Halves are numbers, whatever the points are.
[[nodiscard]] Vec3d half_extent_of(const TriangleSoup& soup);

// Looks at all space where that takes few cubes; else at narrow places alone, and elsewhere at
// where a larger ball comes to.
class Openings {
 public:
  // The mesh bounds a solid; it and its rays outlive this. It is one of so many bodies: cubes are
  // made smaller than they have to be as far as all together may have so many.
  Openings(const TriangleSoup& mesh, const SoupRays& rays, std::size_t most_cubes,
           std::size_t bodies, ProgressObserver* progress)
      : mesh_(mesh),
        rays_(rays),
        extent_(2 * half_extent_of(mesh)),
        most_cubes_(most_cubes),
        bodies_(bodies),
        progress_(progress) {}

  enum class Found { none, some, too_many_cubes };
  // Of the ball with this diameter.
  [[nodiscard]] Found find(double size);
  // It does not take too many cubes.
  [[nodiscard]] bool can_find(double size) const {
    return whole_grid(size).has_value() || narrow_grid(size).has_value();
  }

  // Of what find() found last.
  [[nodiscard]] const SpaceGrid& grid() const { return *grid_; }
  [[nodiscard]] const BallReach& reach() const { return *reach_; }
  [[nodiscard]] const std::vector<BallReach::Face>& closed() const { return closed_; }

 private:
  [[nodiscard]] std::optional<SpaceGrid> whole_grid(double size) const;
  [[nodiscard]] std::optional<SpaceGrid> narrow_grid(double size) const;
  void roll_larger_ball(double size);
  void advance(double share) const;

  const TriangleSoup& mesh_;
  const SoupRays& rays_;
  Vec3d extent_;
  std::size_t most_cubes_;
  std::size_t bodies_;
  ProgressObserver* progress_;
  std::optional<SpaceGrid> coarse_, grid_;
  std::optional<BallReach> larger_, reach_;  // in these
  std::vector<BallReach::Face> closed_;
};

}  // namespace meshrepair::internal
