// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <check/self_intersections.h>
#include <mesh/internal/editable_mesh.h>
#include <mesh/topology.h>
#include <repair/internal/mend_faults.h>

#include "each_seed.h"
#include "random_geometry.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;
using internal::EditableMesh;
using internal::kGone;
using internal::MeshEdit;
using internal::TriangleCorners;

constexpr double kStep = 1e-7;

internal::MendOptions mending(double step = kStep) {
  internal::MendOptions options;
  options.step = step;
  options.within = 16 * step;
  options.rounded = [](const Vec3d& p) { return p; };
  return options;
}

// Flat, of a thickness of twenty steps.
TriangleSoup lens() {
  return transformed(sphere(500), Eigen::Vector3d(1, 1, 10 * kStep).asDiagonal());
}

std::uint32_t highest_point(const TriangleSoup& soup) {
  const auto found = std::max_element(soup.points.begin(), soup.points.end(),
                                      [](const Vec3d& a, const Vec3d& b) { return a.z() < b.z(); });
  return static_cast<std::uint32_t>(found - soup.points.begin());
}

void expect_sphere(const TriangleSoup& mesh) {
  const Topology topology = examine_topology(mesh.triangles, mesh.points.size());
  EXPECT_TRUE(topology.closed());
  EXPECT_TRUE(topology.manifold());
  EXPECT_TRUE(topology.oriented());
  EXPECT_EQ(mesh.points.size(), mesh.triangles.size() / 2 + 2);
}

TEST(MendFaults, PutsAPointBackThatIsBeyondTheOppositeSheet) {
  Surface surface = as_surface(lens());
  const std::uint32_t p = highest_point(surface.mesh);
  surface.mesh.points[p].z() = -20 * kStep;
  const Surface before = surface;
  const SelfIntersections found = self_intersections(surface.mesh);
  ASSERT_GT(found.count, 0u);
  EXPECT_GT(internal::mend_faults(surface, found, mending()), 0u);
  EXPECT_EQ(self_intersections(surface.mesh).count, 0u);
  expect_sphere(surface.mesh);
  ASSERT_EQ(surface.mesh.triangles, before.mesh.triangles);
  for (std::size_t i = 0; i < surface.mesh.points.size(); ++i) {
    const double moved = (surface.mesh.points[i] - before.mesh.points[i]).norm();
    EXPECT_LE(moved, 2 * 128 * kStep);
    EXPECT_EQ(surface.input_point[i] != 0, moved == 0) << i;
  }
}

TEST(MendFaults, LeavesNoTriangleWithoutArea) {
  Surface surface = as_surface(sphere(200));
  // So that there are numbers for the middle of an edge.
  for (Vec3d& p : surface.mesh.points) p = (p * 1024).array().round() / 1024;
  const auto [a, b, c] = surface.mesh.triangles[17];
  surface.mesh.points[a] = 0.5 * (surface.mesh.points[b] + surface.mesh.points[c]);
  const SelfIntersections found = self_intersections(surface.mesh);
  ASSERT_EQ(found.degenerate, 1u);
  EXPECT_GT(internal::mend_faults(surface, found, mending()), 0u);
  const SelfIntersections after = self_intersections(surface.mesh);
  EXPECT_EQ(after.count + after.degenerate, 0u);
  expect_sphere(surface.mesh);
  EXPECT_EQ(surface.source.size(), surface.mesh.triangles.size());
  EXPECT_EQ(surface.input_point.size(), surface.mesh.points.size());
}

TEST(MendFaults, DoesNothingWhereNothingIsWrong) {
  Surface surface = as_surface(lens());
  EXPECT_EQ(internal::mend_faults(surface, self_intersections(surface.mesh), mending()), 0u);
  EXPECT_EQ(surface.mesh.triangles, lens().triangles);
}

// What single precision makes of a lens that is a few of its steps thick.
TEST(MendFaults, LeavesFewerFaultsAndTheTopologyAsItWas) {
  std::size_t faults = 0, left = 0;
  for_each_seed(20, [&](std::uint64_t seed) {
    Random random(seed);
    TriangleSoup soup = transformed(sphere(300), Eigen::Vector3d(1, 1, 3e-7).asDiagonal());
    soup = moved(transformed(soup, random_rotation(random)), {3, 2, 1});
    const auto rounded = [](const Vec3d& p) { return Vec3d(p.cast<float>().cast<double>()); };
    for (Vec3d& p : soup.points) p = rounded(p);
    Surface surface = as_surface(soup);
    const SelfIntersections found = self_intersections(soup);
    internal::MendOptions options = mending(0x1p-22);
    options.rounded = rounded;
    internal::mend_faults(surface, found, options);
    const SelfIntersections after = self_intersections(surface.mesh);
    EXPECT_LE(after.count + after.degenerate, found.count + found.degenerate) << seed;
    faults += found.count + found.degenerate;
    left += after.count + after.degenerate;
    expect_sphere(surface.mesh);
  });
  EXPECT_GT(faults, expected_cases(100u));
  EXPECT_LT(left, faults / 4);
}

TriangleSoup left_of(const EditableMesh& mesh, const TriangleSoup& before) {
  TriangleSoup soup{before.points, {}};
  for (const TriangleCorners& corners : mesh.triangles()) {
    if (corners != kGone) soup.triangles.push_back(corners);
  }
  return soup;
}

TEST(EditableMesh, StaysClosedAndOfTheSameGenus) {
  const TriangleSoup soup = torus(12, 8);
  EditableMesh mesh(soup.triangles, soup.points.size());
  Random random(1);
  std::size_t collapses = 0, flips = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto t =
        static_cast<std::uint32_t>(random.integer(0, static_cast<int>(soup.triangles.size()) - 1));
    if (!mesh.is_left(t)) continue;
    const auto k = static_cast<std::size_t>(random.integer(0, 2));
    const TriangleCorners corners = mesh.triangles()[t];
    MeshEdit edit;
    if (i % 8 == 0 ? mesh.find_collapse(corners[k], corners[(k + 1) % 3], edit)
                   : mesh.find_flip(t, k, edit)) {
      ++(i % 8 == 0 ? collapses : flips);
      mesh.apply(edit);
    }
  }
  EXPECT_GT(collapses, 50u);
  EXPECT_GT(flips, 200u);
  const TriangleSoup after = left_of(mesh, soup);
  const Topology topology = examine_topology(after.triangles, after.points.size());
  EXPECT_TRUE(topology.closed());
  EXPECT_TRUE(topology.manifold());
  EXPECT_TRUE(topology.oriented());
  // Euler's formula for a torus.
  EXPECT_EQ(2 * (soup.points.size() - collapses), after.triangles.size());
}

}  // namespace
}  // namespace meshrepair
