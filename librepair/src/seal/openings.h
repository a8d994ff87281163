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

// Looks at all space where that takes few cubes; else at narrow places alone, and elsewhere at
// where a larger ball comes to.
class Openings {
 public:
  // The mesh bounds a solid; it and its rays outlive this.
  Openings(const TriangleSoup& mesh, const SoupRays& rays, std::size_t most_cubes,
           ProgressObserver* progress)
      : mesh_(mesh), rays_(rays), most_cubes_(most_cubes), progress_(progress) {}

  enum class Found { none, some, too_many_cubes };
  // Of the ball with this diameter.
  [[nodiscard]] Found find(double size);

  // Of what find() found last.
  [[nodiscard]] const SpaceGrid& grid() const { return *grid_; }
  [[nodiscard]] const BallReach& reach() const { return *reach_; }
  [[nodiscard]] const std::vector<BallReach::Face>& closed() const { return closed_; }

 private:
  [[nodiscard]] std::optional<SpaceGrid> whole_grid(double size) const;
  [[nodiscard]] std::optional<SpaceGrid> narrow_grid(double size) const;
  void roll_larger_ball(double size);

  const TriangleSoup& mesh_;
  const SoupRays& rays_;
  std::size_t most_cubes_;
  ProgressObserver* progress_;
  std::optional<SpaceGrid> coarse_, grid_;
  std::optional<BallReach> larger_, reach_;  // in these
  std::vector<BallReach::Face> closed_;
};

// Of the bounding box of all points; there is one.
[[nodiscard]] Vec3d extent_of(const TriangleSoup& soup);

}  // namespace meshrepair::internal
