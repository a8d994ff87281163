// SPDX-License-Identifier: MIT
#include "seal/seal_lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "revolved.h"
#include "seal/openings.h"

namespace meshrepair::internal {
namespace {

SealLattice lattice_of(const TriangleSoup& shell, double size, double& step) {
  const std::vector<std::int32_t> no_winding(shell.triangles.size(), 0);
  const SoupRays rays(shell, no_winding);
  Openings openings(shell, rays, std::size_t{1} << 20, 1, nullptr);
  EXPECT_EQ(openings.find(size), Openings::Found::some);
  step = openings.grid().step();
  return make_seal_lattice(openings.grid(), openings.reach(), openings.closed(), 1);
}

// How far a number is from a multiple of the step.
double beside_multiple(double x, double step) {
  return std::abs(x - step * std::round(x / step)) / step;
}

// A ray from the uppermost corner of a marker tells in which chamber it is, but not where it meets
// an edge: the faces above are divided along their diagonals.
TEST(SealLattice, MarkersEndAboveTheEdgesOfTheLattice) {
  double step = 0;
  const SealLattice lattice = lattice_of(testing::pierced_shell(0.1, 0.1, 48), 0.27, step);
  const std::vector<Vec3d>& points = lattice.soup.points;
  const Vec3d& low = points[lattice.soup.triangles[0][0]];  // of some cube
  ASSERT_GT(lattice.is_behind.size(), 10u);
  for (std::size_t t = lattice.first_marker; t < lattice.soup.triangles.size();
       t += SealLattice::kTrianglesOfMarker) {
    // Its four corners follow each other; the first triangle leaves out the first one.
    const std::uint32_t first = lattice.soup.triangles[t][0] - 1;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto top =
          std::max_element(points.begin() + first, points.begin() + first + 4,
                           [&](const Vec3d& a, const Vec3d& b) { return a[axis] < b[axis]; });
      const Vec3d at = *top - low;
      const double u = at[(axis + 1) % 3], v = at[(axis + 2) % 3];
      EXPECT_GT(beside_multiple(u - v, step), 1e-4) << t << " " << axis;
      EXPECT_GT(beside_multiple(u, step), 0.1) << t << " " << axis;
      EXPECT_GT(beside_multiple(v, step), 0.1) << t << " " << axis;
    }
  }
}

}  // namespace
}  // namespace meshrepair::internal
