// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <check/internal/fault_counter.h>

#include "shapes.h"

namespace meshrepair::internal {
namespace {

using namespace testing;

TEST(FaultCounter, CountsPairsThatMeet) {
  TriangleSoup mesh = cube();
  append(mesh, moved(cube(), {0.5, 0.25, 0.125}));
  FaultCounter counter(mesh, 1, {});
  const EditableMesh editable(mesh.triangles, mesh.points.size());
  std::ptrdiff_t faults = 0;
  for (std::uint32_t t = 0; t < 12; ++t) faults += counter.start(editable, std::array{t});
  EXPECT_GT(faults, 0);
  EXPECT_EQ(counter.start(editable, std::array{0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 10u, 11u}),
            faults);
}

// Sheets of all distances, some of them less than what points are moved by.
TEST(FaultCounter, LeavesOutNothingThatMovingCanChange) {
  Random random(1);
  std::ptrdiff_t changed = 0;
  for (const double beside : {1e-6, 1e-3, 0.02, 0.3}) {
    TriangleSoup mesh = noisy_sphere(400, 0.05, 7);
    append(mesh, moved(mesh, {beside, 2 * beside, -beside}));
    const double step = 0.01;
    Box half;
    half.add(Vec3d(-2, -2, -2));
    half.add(Vec3d(0, 2, 2));
    FaultCounter some(mesh, 2 * step, {half}), all(mesh, 2 * step, {});
    const EditableMesh editable(mesh.triangles, mesh.points.size());
    for (int i = 0; i < 100; ++i) {
      const auto p = static_cast<std::uint32_t>(
          random.integer(0, static_cast<std::int32_t>(mesh.points.size()) - 1));
      const std::span<const std::uint32_t> star = editable.triangles_of(p);
      std::vector<TriangleCorners> corners;
      for (const std::uint32_t t : star) corners.push_back(mesh.triangles[t]);
      const std::ptrdiff_t before = some.start(editable, star, 2 * step);
      ASSERT_EQ(all.start(editable, star), before);
      const Vec3d from = mesh.points[p];
      for (int move = 0; move < 4; ++move) {
        mesh.points[p] =
            from + step * Vec3d(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
        const std::ptrdiff_t after = all.count(corners);
        ASSERT_EQ(some.count(corners), after);
        ASSERT_GT(some.count(corners, after - 1), after - 1);
        changed += after != before;
      }
      mesh.points[p] = from;
    }
  }
  EXPECT_GT(changed, 100);
}

}  // namespace
}  // namespace meshrepair::internal
