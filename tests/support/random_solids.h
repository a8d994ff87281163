// SPDX-License-Identifier: MIT
// Random solids, and pairs of them, for Boolean operations.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <mesh/soup.h>

#include "random_geometry.h"
#include "shapes.h"

namespace meshrepair::testing {

inline TriangleSoup lattice_box(Random& random) {
  Vec3d low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = random.integer(0, 3);
    low[axis] = a;
    high[axis] = random.integer(a + 1, 4);
  }
  return box(low, high);
}

// A ball whose points went in or out at random.
inline TriangleSoup bumpy_ball(Random& random) {
  TriangleSoup soup = sphere(static_cast<std::size_t>(random.integer(20, 200)));
  for (Vec3d& p : soup.points) p *= random.real(0.4, 1.3);
  return soup;
}

inline TriangleSoup random_solid(Random& random) {
  TriangleSoup soup;
  switch (random.integer(0, 3)) {
    case 0:
      soup = cube();
      break;
    case 1:
      soup = sphere(static_cast<std::size_t>(random.integer(20, 300)));
      break;
    case 2:
      soup = torus(12, 8, 1, 0.4);
      break;
    default:
      soup = bumpy_ball(random);
      break;
  }
  const Eigen::Quaterniond turn(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1),
                                random.real(-1, 1));
  soup = transformed(soup, turn.normalized().toRotationMatrix());
  return moved(soup, {random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
}

// In half of the pairs on a common lattice: equal, nested, side by side, or touching.
inline std::vector<TriangleSoup> random_pair(std::uint64_t seed) {
  Random random(seed);
  if (seed % 2 == 0) return {random_solid(random), random_solid(random)};
  if (seed % 4 == 1) return {lattice_box(random), lattice_box(random)};
  std::vector<TriangleSoup> pair(2, bumpy_ball(random));
  if (seed % 8 == 3) {  // the same turned by a quarter: poles in common
    for (Vec3d& p : pair[1].points) p = {-p.y(), p.x(), p.z()};
  }
  return pair;
}

}  // namespace meshrepair::testing
