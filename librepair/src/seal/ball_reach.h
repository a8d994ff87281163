// SPDX-License-Identifier: MIT
// Where a ball comes to that rolls around a surface from outside, and what lies deep behind.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <check/internal/nearest_triangle.h>
#include <check/soup_rays.h>

#include "space_grid.h"

namespace meshrepair::internal {

class BallReach {
 public:
  // A place that a larger ball comes to, this one comes to as well: `larger` tells where the ball
  // is in a grid of narrow places. All outlive this.
  BallReach(const SpaceGrid& grid, const SoupRays& rays, double radius,
            const BallReach* larger = nullptr)
      : grid_(grid), rays_(rays), radius_(radius), larger_(larger) {}

  // Finds where the ball comes to; find() does so, too.
  void roll_around(ProgressObserver* progress);
  // Finds what is to be closed: see seal_openings(). False if it is nothing.
  bool find(ProgressObserver* progress);

  // A face of a cube where the way to what is closed is closed off: towards `inner`.
  struct Face {
    std::uint32_t outer = 0, inner = 0;  // neighbours
  };
  // In the order of the outer cubes' places.
  [[nodiscard]] std::vector<Face> closed_faces(ProgressObserver* progress) const;

  [[nodiscard]] bool is_reached(std::uint32_t cube) const { return reached_[cube] != 0; }
  // It is to be closed off.
  [[nodiscard]] bool is_behind(std::uint32_t cube) const;
  // Whether nothing is between the centres of two cubes.
  [[nodiscard]] bool is_free(std::uint32_t a, std::uint32_t b) const;

 private:
  void put_centres(ProgressObserver* progress);
  [[nodiscard]] bool is_asked(std::uint32_t cube) const;
  void spread_from(std::uint32_t first, ProgressObserver* progress);
  [[nodiscard]] bool gets_to_larger(const Vec3d& from, const Vec3d& place,
                                    const NearestTriangle& nearest) const;
  [[nodiscard]] bool gets_beside(const Vec3d& from, const NearestTriangle& nearest) const;
  [[nodiscard]] bool gets_straight(const Vec3d& from, const Vec3d& to,
                                   const NearestTriangle& nearest) const;
  void roll(ProgressObserver* progress);
  std::vector<std::uint32_t> find_depths(ProgressObserver* progress);
  bool find_deep(const std::vector<std::uint32_t>& by_depth, ProgressObserver* progress);
  void grow_back(ProgressObserver* progress);
  [[nodiscard]] bool is_open(std::uint32_t node) const;
  [[nodiscard]] bool is_deep(std::uint32_t cube) const;
  [[nodiscard]] bool widens(std::uint32_t cube) const;
  // Calls visit(cube, length of the step) for the cubes around one that there is a free way to.
  template <class Visit>
  void visit_around(std::uint32_t cube, Visit visit) const;

  const SpaceGrid& grid_;
  const SoupRays& rays_;
  double radius_;
  const BallReach* larger_;
  std::vector<char> reached_;  // of each node: the ball's centre comes there (2), or the ball (1)
  std::vector<std::uint32_t> centre_of_;  // of each node that is reached: a centre of the ball
  std::vector<float> depth_;         // of each cube that is not reached: the way from one that is
  std::vector<std::uint32_t> deep_;  // cubes that are deep, or behind such
  // Of each cube, how much farther it is from these than they are from what is reached.
  std::vector<float> back_;
};

}  // namespace meshrepair::internal
