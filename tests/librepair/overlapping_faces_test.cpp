// SPDX-License-Identifier: MIT
// Closed surfaces that overlap, or lie on each other, with faces in common.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <check/mesh_distance.h>
#include <repair/repair.h>

#include "random_geometry.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

using Tetrahedron = std::array<Vec3d, 4>;

double six_volumes(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

// Between few points, so that many have a face in common, on either side of it.
std::vector<Tetrahedron> tetrahedra_of(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::array<Vec3d, 7> corners;
  for (Vec3d& p : corners) p = {random.real(0, 1), random.real(0, 1), random.real(0, 1)};
  std::vector<Tetrahedron> all;
  while (all.size() < count) {
    for (std::size_t i = 0; i < 4; ++i) {
      std::swap(corners[i], corners[static_cast<std::size_t>(random.integer(0, 6))]);
    }
    Tetrahedron t;
    std::copy_n(corners.begin(), 4, t.begin());
    if (six_volumes(t[0], t[1], t[2], t[3]) < 0) std::swap(t[2], t[3]);
    all.push_back(t);
  }
  return all;
}

TriangleSoup soup_of(const std::vector<Tetrahedron>& tetrahedra) {
  TriangleSoup soup;
  for (const Tetrahedron& t : tetrahedra) {
    append(soup, {{t[0], t[1], t[2], t[3]}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
  }
  return soup;
}

bool is_inside(const Tetrahedron& t, const Vec3d& p) {
  return six_volumes(p, t[1], t[2], t[3]) > 0 && six_volumes(t[0], p, t[2], t[3]) > 0 &&
         six_volumes(t[0], t[1], p, t[3]) > 0 && six_volumes(t[0], t[1], t[2], p) > 0;
}

// By points at random in the unit cube.
double volume_of_union(const std::vector<Tetrahedron>& tetrahedra) {
  constexpr int kPoints = 100'000;
  Random random(1);
  int inside = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3d p(random.real(0, 1), random.real(0, 1), random.real(0, 1));
    inside += std::any_of(tetrahedra.begin(), tetrahedra.end(),
                          [&](const Tetrahedron& t) { return is_inside(t, p); });
  }
  return static_cast<double>(inside) / kPoints;
}

TEST(OverlappingFaces, OverlappingTetrahedraAreUnited) {
  for (std::uint64_t seed = 0; seed < share_of_cases(30u); ++seed) {
    const std::vector<Tetrahedron> tetrahedra = tetrahedra_of(3 + seed % 6, seed);
    for (const InsideRule rule : {InsideRule::automatic, InsideRule::winding}) {
      RepairOptions options;
      options.inside.rule = rule;
      const RepairResult result = repair(soup_of(tetrahedra), options);
      EXPECT_TRUE(result.report.certify.passed()) << seed;
      EXPECT_NEAR(result.report.output_volume, volume_of_union(tetrahedra), 0.006) << seed;
    }
  }
}

// On the working grid most triangles of the two are the same, and some are not.
TEST(OverlappingFaces, FacesOfAShiftedCopyAreOnTheSurface) {
  for (const double offset : {1e-10, 1e-9, 1e-8, 3e-8}) {
    TriangleSoup soup = transformed(
        torus(20, 10), Eigen::AngleAxisd(0.3, Vec3d(1, 2, 3).normalized()).toRotationMatrix());
    const double volume = signed_volume(soup);
    append(soup, moved(soup, Vec3d(1, -0.7, 0.4) * offset));
    const RepairResult result = repair(soup);
    EXPECT_TRUE(result.report.certify.passed()) << offset;
    EXPECT_EQ(result.report.inside.contradictions, 0u) << offset;
    EXPECT_NEAR(result.report.output_volume, volume, 1e-5) << offset;
    EXPECT_LT(mesh_distance(result.surface.mesh, soup).forth.largest, 1e-6) << offset;
  }
}

TEST(OverlappingFaces, ListedSeveralTimesAreOne) {
  TriangleSoup soup = cube();
  soup.triangles.insert(soup.triangles.end(), 3, soup.triangles[4]);
  soup.triangles.push_back(soup.triangles[5]);
  EXPECT_DOUBLE_EQ(repair(soup).report.output_volume, 1);
  TriangleSoup doubled = cube();
  append(doubled, cube());
  EXPECT_DOUBLE_EQ(repair(doubled).report.output_volume, 1);
}

}  // namespace
}  // namespace meshrepair
