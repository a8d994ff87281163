// SPDX-License-Identifier: MIT
// Bodies that are hollow by mistake become full, and others stay as they are.
#include "seal/double_walls.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/append_soup.h>
#include <mesh/topology.h>
#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair::internal {
namespace {

using namespace testing;

constexpr std::uint32_t kRows = 24, kColumns = 48;
constexpr double kWall = 0.06;

// So many cells wide and high, its lowest corner in this row and column.
struct SquareHole {
  std::uint32_t row, column, cells;
  [[nodiscard]] bool has(std::uint32_t i, std::uint32_t j) const {
    return i >= row && i < row + cells && j >= column && j < column + cells;
  }
};

// Two walls of a ball of radius 1, the points of the inner one behind those of the outer one.
class HollowBall {
 public:
  explicit HollowBall(std::vector<SquareHole> holes) : holes_(std::move(holes)) {
    for (const double radius : {1.0, 1 - kWall}) {
      for (std::uint32_t i = 1; i < kRows; ++i) {
        for (std::uint32_t j = 0; j < kColumns; ++j) {
          const double theta = std::numbers::pi * i / kRows;
          const double phi = 2 * std::numbers::pi * j / kColumns;
          soup_.points.push_back(radius * Vec3d(std::sin(theta) * std::cos(phi),
                                                std::sin(theta) * std::sin(phi), std::cos(theta)));
        }
      }
      soup_.points.emplace_back(0, 0, radius);
      soup_.points.emplace_back(0, 0, -radius);
    }
  }

  TriangleSoup with_holes() {
    add_walls();
    for (const SquareHole& hole : holes_) {
      for (std::uint32_t k = 0; k < hole.cells; ++k) {
        add_tube(at(hole.row, hole.column + k), at(hole.row, hole.column + k + 1));
        add_tube(at(hole.row + hole.cells, hole.column + k + 1),
                 at(hole.row + hole.cells, hole.column + k));
        add_tube(at(hole.row + k + 1, hole.column), at(hole.row + k, hole.column));
        add_tube(at(hole.row + k, hole.column + hole.cells),
                 at(hole.row + k + 1, hole.column + hole.cells));
      }
    }
    return soup_;
  }

 private:
  static std::uint32_t at(std::uint32_t i, std::uint32_t j) { return i * kColumns + j % kColumns; }

  // Of the outer wall, and the same of the inner one, which faces the other way.
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto inner = static_cast<std::uint32_t>(soup_.points.size() / 2);
    soup_.triangles.push_back({a, b, c});
    soup_.triangles.push_back({c + inner, b + inner, a + inner});
  }

  void add_walls() {
    for (std::uint32_t i = 0; i + 2 < kRows; ++i) {
      for (std::uint32_t j = 0; j < kColumns; ++j) {
        bool is_hole = false;
        for (const SquareHole& hole : holes_) is_hole |= hole.has(i, j);
        if (is_hole) continue;
        add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
    const std::uint32_t top = (kRows - 1) * kColumns;
    for (std::uint32_t j = 0; j < kColumns; ++j) {
      add(top, at(0, j), at(0, j + 1));
      add(top + 1, at(kRows - 2, j + 1), at(kRows - 2, j));
    }
  }

  // A side of the wall that is there runs from a to b.
  void add_tube(std::uint32_t a, std::uint32_t b) {
    const auto inner = static_cast<std::uint32_t>(soup_.points.size() / 2);
    soup_.triangles.push_back({b, a, a + inner});
    soup_.triangles.push_back({b, a + inner, b + inner});
  }

  TriangleSoup soup_;
  std::vector<SquareHole> holes_;
};

Surface with_walls_filled(const TriangleSoup& soup, RepairReport& report) {
  RepairOptions options;
  options.seal.double_walls = true;
  Surface surface = repair(soup, options, report);
  EXPECT_TRUE(report.certify.passed());
  return surface;
}

TEST(DoubleWalls, PinholesAreClosedAndTheBodyIsFull) {
  const TriangleSoup ball = HollowBall({{6, 3, 1}, {12, 20, 1}, {16, 40, 1}}).with_holes();
  RepairReport report;
  const Surface solid = with_walls_filled(ball, report);
  EXPECT_EQ(report.seal.double_walls, 1u);
  EXPECT_EQ(report.seal.openings, 3u);
  EXPECT_NEAR(signed_volume(solid.mesh), 4 * std::numbers::pi / 3, 0.1);
  // All of the outer wall is there.
  EXPECT_GE(report.triangles.untouched, kColumns * (kRows - 1) * 2 - 16);
  EXPECT_GT(report.seal.patches_area, 0);
  EXPECT_NEAR(report.seal.filled_volume, signed_volume(solid.mesh) - signed_volume(ball), 1e-9);
}

TEST(DoubleWalls, WiderOpeningsAreMeant) {
  for (const std::uint32_t cells : {5u, 8u}) {
    const TriangleSoup ball = HollowBall({{8, 10, cells}}).with_holes();
    RepairReport report;
    const Surface solid = with_walls_filled(ball, report);
    EXPECT_EQ(report.seal.double_walls, 0u);
    EXPECT_EQ(report.triangles.untouched, ball.triangles.size());
    EXPECT_DOUBLE_EQ(signed_volume(solid.mesh), signed_volume(ball));
  }
}

TEST(DoubleWalls, EachBodyIsLookedAtByItself) {
  TriangleSoup bodies = HollowBall({{12, 20, 1}}).with_holes();
  TriangleSoup vessel = HollowBall({{8, 10, 8}}).with_holes();
  for (Vec3d& p : vessel.points) p.x() += 5;
  const double own = signed_volume(vessel);
  append_soup(bodies, vessel);
  RepairReport report;
  const Surface solid = with_walls_filled(bodies, report);
  EXPECT_EQ(report.seal.double_walls, 1u);
  EXPECT_NEAR(signed_volume(solid.mesh), 4 * std::numbers::pi / 3 + own, 0.1);
}

TEST(DoubleWalls, AFullBodyHasNone) {
  RepairReport report;
  EXPECT_EQ(find_double_walls(repair(cube(), {}, report), nullptr).bodies, 0u);
  EXPECT_EQ(find_double_walls(Surface(), nullptr).bodies, 0u);
}

}  // namespace
}  // namespace meshrepair::internal
