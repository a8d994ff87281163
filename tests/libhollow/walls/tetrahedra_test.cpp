// SPDX-License-Identifier: MIT
#include "walls/tetrahedra.h"

#include <array>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "random_geometry.h"

namespace meshrepair::internal {
namespace {

Box unit_box() {
  Box box;
  box.add(Vec3d(0, 0, 0));
  box.add(Vec3d(1, 1, 1));
  return box;
}

double volume(const Tetrahedra& grid, std::uint32_t cell) {
  const auto& [a, b, c, d] = grid.corners(cell);
  const auto& points = grid.points();
  return std::abs((points[b] - points[a]).cross(points[c] - points[a]).dot(points[d] - points[a])) /
         6;
}

double volume(const Tetrahedra& grid) {
  double sum = 0;
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell) sum += volume(grid, cell);
  return sum;
}

// Each face has two tetrahedra, but for those on the border: no corner lies on a face of another.
std::size_t faces_on_the_border(const Tetrahedra& grid) {
  std::map<std::array<std::uint32_t, 3>, int> faces;
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<std::uint32_t, 3> face{};
      std::size_t n = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        if (j != i) face[n++] = grid.corners(cell)[j];
      }
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  std::size_t alone = 0;
  for (const auto& [face, count] : faces) {
    EXPECT_LE(count, 2);
    alone += count == 1 ? 1 : 0;
  }
  return alone;
}

// The area of the border, in halves of squares that are not smaller than the coarsest.
TEST(Tetrahedra, FitTogetherWhereverTheyAreBisected) {
  testing::Random random(7);
  Tetrahedra grid(unit_box(), 1.0);
  EXPECT_EQ(grid.take_changed().size(), grid.size());
  const double all = volume(grid);
  for (int i = 0; i < 400; ++i) {
    grid.bisect(
        static_cast<std::uint32_t>(random.integer(0, static_cast<std::int32_t>(grid.size()) - 1)));
  }
  EXPECT_NEAR(volume(grid), all, 1e-12 * all);
  for (const std::uint32_t cell : grid.take_changed()) {
    EXPECT_GT(volume(grid, cell), 0);
    EXPECT_GT(grid.level(cell), 0);
  }
  // A corner on a face of a neighbour would leave three faces with one tetrahedron within.
  std::size_t within = 0;
  const std::size_t border = faces_on_the_border(grid);
  Box box;
  for (const Vec3d& point : grid.points()) box.add(point);
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        int low = 0, high = 0;
        for (std::size_t j = 0; j < 4; ++j) {
          if (j == i) continue;
          const double x = grid.points()[grid.corners(cell)[j]][k];
          low += x == box.low[static_cast<std::size_t>(k)] ? 1 : 0;
          high += x == box.high[static_cast<std::size_t>(k)] ? 1 : 0;
        }
        within += low == 3 || high == 3 ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(border, within);
}

TEST(Tetrahedra, CoverTheBox) {
  Tetrahedra grid(unit_box(), 0.3);
  Box box;
  for (const Vec3d& point : grid.points()) box.add(point);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(box.low[k], 0);
    EXPECT_GT(box.high[k], 1);
  }
}

}  // namespace
}  // namespace meshrepair::internal
