// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <check/check_surface.h>
#include <check/mesh_distance.h>
#include <mesh/edge_table.h>
#include <mesh/precision.h>
#include <mesh/topology.h>
#include <simplify/decimate.h>

#include "each_seed.h"
#include "point_clouds.h"
#include "random_geometry.h"
#include "random_solids.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

DecimatedMesh reduced(const TriangleSoup& mesh, std::size_t triangles,
                      Precision precision = Precision::float64, DecimationReport* told = nullptr) {
  DecimationOptions options;
  options.triangles = triangles;
  options.precision = precision;
  DecimationReport report;
  DecimatedMesh result = decimate(mesh, options, report);
  if (told != nullptr) *told = report;
  return result;
}

std::int64_t genus(const TriangleSoup& mesh) {
  return genus_of(examine_topology(mesh.triangles, mesh.points.size()), mesh.points.size());
}

void expect_same_kind(const TriangleSoup& before, const TriangleSoup& after) {
  const SurfaceCheck a = check_surface(before), b = check_surface(after);
  EXPECT_TRUE(b.valid_solid());
  EXPECT_EQ(a.parts.size(), b.parts.size());
  EXPECT_EQ(a.cavities, b.cavities);
  EXPECT_EQ(b[Defect::unused_point].count, 0u);
  EXPECT_EQ(genus(before), genus(after));
}

TEST(Decimate, ReachesTheCountWhereNothingForbidsIt) {
  const TriangleSoup mesh = sphere(2000);
  ASSERT_GT(mesh.triangles.size(), 1900u);
  for (const std::size_t count : {1899u, 1000u, 201u, 20u, 4u, 0u}) {
    const DecimatedMesh few = reduced(mesh, count);
    SCOPED_TRACE(count);
    // In pairs; and to the last one, something is in the way.
    EXPECT_LE(few.mesh.triangles.size(), std::max<std::size_t>(count, 8));
    EXPECT_GT(few.mesh.triangles.size() + 2, count);
    expect_same_kind(mesh, few.mesh);
  }
}

TEST(Decimate, LeavesAloneWhatIsSmallEnough) {
  const TriangleSoup mesh = torus(12, 8);
  const DecimatedMesh same = reduced(mesh, mesh.triangles.size());
  EXPECT_EQ(same.mesh.triangles.size(), mesh.triangles.size());
  for (std::uint32_t t = 0; t < same.source.size(); ++t) EXPECT_EQ(same.source[t], t);
}

TEST(Decimate, FlatFacesCostNothing) {
  const TriangleSoup mesh = cubes_boundary({9, 7, 5}, [](int, int, int) { return true; });
  const DecimatedMesh few = reduced(mesh, 12);
  EXPECT_EQ(few.mesh.triangles.size(), 12u);
  expect_same_kind(mesh, few.mesh);
  EXPECT_NEAR(check_surface(few.mesh).volume, 9 * 7 * 5, 1e-9);
}

TEST(Decimate, HandlesStay) {
  const TriangleSoup mesh = genus_five_body();
  DecimationReport report;
  const DecimatedMesh few = reduced(mesh, 0, Precision::float64, &report);
  EXPECT_EQ(genus(few.mesh), 5);
  expect_same_kind(mesh, few.mesh);
  EXPECT_GT(report.would_change_topology + report.would_fold + report.would_meet, 0u);
}

// Nested shells that are nearly in touch, as far as it goes.
TEST(Decimate, NothingMeetsWhereShellsAreNear) {
  for (const double gap : {1e-2, 1e-4, 1e-8}) {
    SCOPED_TRACE(gap);
    TriangleSoup mesh = sphere(800);
    mesh = together(mesh, flipped(scaled(sphere(800), 1 - gap)));
    mesh = together(mesh, scaled(sphere(800), 1 - 3 * gap));
    const DecimatedMesh few = reduced(mesh, 0);
    EXPECT_LT(few.mesh.triangles.size(), mesh.triangles.size());
    expect_same_kind(mesh, few.mesh);
  }
}

TEST(Decimate, NoPartSwallowsASmallOne) {
  TriangleSoup mesh = sphere(3000);
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    const Vec3d way(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
    mesh = together(mesh, moved(scaled(sphere(20), 1e-3), 1.005 * way.normalized()));
  }
  for (const std::size_t count : {1200u, 500u, 0u}) {
    const DecimatedMesh few = reduced(mesh, count);
    SCOPED_TRACE(count);
    expect_same_kind(mesh, few.mesh);
  }
}

TEST(Decimate, RandomSolidsStaySolids) {
  for_each_seed(1000, [](std::uint64_t seed) {
    Random random(seed);
    const TriangleSoup mesh = random_solid(random);
    if (!check_surface(mesh).valid_solid()) return;
    const auto precision = seed % 2 == 0 ? Precision::float64 : Precision::float32;
    TriangleSoup given = mesh;
    for (Vec3d& p : given.points) p = internal::rounded_to(p, precision);
    const std::size_t count = given.triangles.size();
    for (const std::size_t target : {count / 2, count / 10, std::size_t{0}}) {
      const DecimatedMesh few = reduced(given, target, precision);
      expect_same_kind(given, few.mesh);
      for (const Vec3d& p : few.mesh.points) {
        EXPECT_EQ(internal::rounded_to(p, precision), p);
      }
    }
  });
}

// Points of the input say what they became, triangles what they were.
TEST(Decimate, TellsWhatBecameOfWhat) {
  const TriangleSoup mesh = torus(40, 20);
  const DecimatedMesh few = reduced(mesh, 300);
  ASSERT_EQ(few.point.size(), mesh.points.size());
  ASSERT_EQ(few.source.size(), few.mesh.triangles.size());
  for (std::size_t t = 0; t < few.source.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(few.point[mesh.triangles[few.source[t]][k]], few.mesh.triangles[t][k]);
    }
  }
}

TEST(Decimate, ScalingByPowersOfTwoChangesNothing) {
  const TriangleSoup mesh = noisy_sphere(600, 0.01, 3);
  ASSERT_TRUE(check_surface(mesh).valid_solid());
  const DecimatedMesh few = reduced(mesh, 100);
  for (const double scale : {0x1p-600, 0x1p-60, 0x1p40, 0x1p500}) {
    const DecimatedMesh other = reduced(scaled(mesh, scale), 100);
    EXPECT_EQ(other.mesh.triangles, few.mesh.triangles);
    EXPECT_EQ(other.mesh.points, scaled(few.mesh, scale).points);
  }
}

TEST(Decimate, IsNearerThanItsTriangles) {
  const TriangleSoup mesh = sphere(8000);
  const MeshDistance distance = mesh_distance(mesh, reduced(mesh, 800).mesh);
  EXPECT_LT(distance.forth.mean, 1.4e-3);
  EXPECT_LT(distance.largest(), 1.2e-2);
}

// Sides between triangles above and below the plane z = 0.
std::vector<std::uint8_t> seams_between(const TriangleSoup& mesh, const std::vector<char>& above) {
  std::vector<std::uint8_t> seams(mesh.triangles.size(), 0);
  EdgeTable(mesh.triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (above[sides[0] / 3] == above[sides[1] / 3]) return;
    for (const std::uint32_t s : sides) {
      seams[s / 3] = static_cast<std::uint8_t>(seams[s / 3] | 1u << s % 3);
    }
  });
  return seams;
}

struct Halves {
  TriangleSoup mesh = torus(60, 30);
  std::vector<char> above;
  std::vector<std::uint8_t> seams;

  Halves() {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) above.push_back(is_above(mesh, t));
    seams = seams_between(mesh, above);
  }

  static char is_above(const TriangleSoup& soup, std::size_t t) {
    const auto& c = soup.triangles[t];
    return (soup.points[c[0]] + soup.points[c[1]] + soup.points[c[2]]).z() > 0 ? 1 : 0;
  }

  [[nodiscard]] DecimatedMesh reduced() const {
    DecimationOptions options;
    options.triangles = 300;
    options.seams = seams;
    options.find_corners = true;
    DecimationReport report;
    return decimate(mesh, options, report);
  }
};

TEST(Decimate, SeamsStay) {
  const Halves halves;
  const DecimatedMesh few = halves.reduced();
  expect_same_kind(halves.mesh, few.mesh);
  EXPECT_LE(few.mesh.triangles.size(), 301u);
  for (std::size_t t = 0; t < few.source.size(); ++t) {
    EXPECT_EQ(halves.above[few.source[t]], Halves::is_above(few.mesh, t));
  }
}

// What is near on the other side of a seam does not count.
TEST(Decimate, CornersLieOnTheirSideOfSeams) {
  const Halves halves;
  const DecimatedMesh few = halves.reduced();
  ASSERT_EQ(few.corners.size(), 3 * few.mesh.triangles.size());
  const MeshDistance distance = mesh_distance(few.mesh, halves.mesh);
  for (std::size_t c = 0; c < few.corners.size(); ++c) {
    EXPECT_EQ(halves.above[few.corners[c].triangle], Halves::is_above(few.mesh, c / 3));
    const Vec3d& corner = few.mesh.points[few.mesh.triangles[c / 3][c % 3]];
    EXPECT_LE((few.corners[c].place - corner).norm(), 1.1 * distance.forth.largest);
  }
}

TEST(Decimate, CornersThatDidNotMoveAreWhereTheyWere) {
  const Halves halves;
  const DecimatedMesh few = halves.reduced();
  for (std::size_t c = 0; c < few.corners.size(); ++c) {
    const auto& given = halves.mesh.triangles[few.corners[c].triangle];
    const Vec3d& corner = few.mesh.points[few.mesh.triangles[c / 3][c % 3]];
    for (const std::uint32_t p : given) {
      if (halves.mesh.points[p] != corner) continue;
      EXPECT_EQ(few.corners[c].place, corner);
    }
  }
}

// Each triangle into four.
TriangleSoup divided(const TriangleSoup& soup) {
  TriangleSoup result{soup.points, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(result.points.size());
    const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), next);
    if (is_new) result.points.emplace_back(0.5 * (result.points[a] + result.points[b]));
    return found->second;
  };
  for (const auto& [a, b, c] : soup.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    result.triangles.insert(result.triangles.end(),
                            {{{a, ab, ca}}, {{ab, b, bc}}, {{ca, bc, c}}, {{bc, ca, ab}}});
  }
  return result;
}

TEST(Decimate, FlatFacesGoFirst) {
  const TriangleSoup mesh = divided(divided(divided(divided(cube()))));
  for (const std::size_t count : {2000u, 1000u, 300u, 100u, 12u}) {
    const DecimatedMesh few = reduced(mesh, count);
    EXPECT_LE(few.mesh.triangles.size(), count);
    EXPECT_LT(mesh_distance(mesh, few.mesh).largest(), 1e-9);
  }
}

// Its sides are of slivers, which must not stay at the cost of everything else.
TEST(Decimate, ThinPlatesOfManyTrianglesKeepTheirShape) {
  TriangleSoup mesh = divided(divided(divided(divided(cube()))));
  for (Vec3d& p : mesh.points) p = p.cwiseProduct(Vec3d(60, 60, 0.1));
  const DecimatedMesh few = reduced(mesh, mesh.triangles.size() / 20);
  EXPECT_LE(few.mesh.triangles.size(), mesh.triangles.size() / 20);
  EXPECT_LT(mesh_distance(mesh, few.mesh).largest(), 1e-6);
}

TEST(Decimate, FansOfManyTrianglesDoNotStopWhatIsAround) {
  const TriangleSoup mesh = cone(1000);
  const DecimatedMesh few = reduced(mesh, mesh.triangles.size() / 5);
  expect_same_kind(mesh, few.mesh);
  EXPECT_LE(few.mesh.triangles.size(), mesh.triangles.size() / 5);
}

// Linear on both sides of a plane: no triangle reaches over it.
TEST(Decimate, ValuesCountOnFlatFaces) {
  const TriangleSoup mesh = divided(divided(divided(cube())));
  std::vector<double> values;
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t p : t) values.push_back(std::abs(mesh.points[p].x() - 0.5));
  }
  DecimationOptions options;
  options.triangles = 60;
  options.values = values;
  options.values_of_corner = 1;
  DecimationReport report;
  const DecimatedMesh few = decimate(mesh, options, report);
  EXPECT_LE(few.mesh.triangles.size(), 60u);
  for (const auto& t : few.mesh.triangles) {
    double least = 0, most = 0;
    for (const std::uint32_t p : t) {
      least = std::min(least, few.mesh.points[p].x() - 0.5);
      most = std::max(most, few.mesh.points[p].x() - 0.5);
    }
    EXPECT_TRUE(least > -1e-6 || most < 1e-6) << least << " to " << most;
  }
}

TEST(Decimate, FlatFacesCostNoDistance) {
  DecimationOptions options;
  options.distance = 1e-9;
  DecimationReport report;
  const DecimatedMesh few = decimate(divided(divided(divided(cube()))), options, report);
  EXPECT_EQ(few.mesh.triangles.size(), 12u);
}

TEST(Decimate, PointsStayWithinTheDistance) {
  const TriangleSoup mesh = noisy_sphere(3000, 0.01, 1);
  std::size_t last = 0;
  for (const double most : {0.03, 0.01, 0.003}) {
    DecimationOptions options;
    options.distance = most;
    DecimationReport report;
    const DecimatedMesh few = decimate(mesh, options, report);
    expect_same_kind(mesh, few.mesh);
    EXPECT_GT(few.mesh.triangles.size(), last);
    last = few.mesh.triangles.size();
    EXPECT_GT(report.would_part, 0u);
    // Corners of the one and of the other, from all of the surface.
    DistanceOptions corners;
    corners.samples = 1;
    EXPECT_LE(mesh_distance(mesh, few.mesh, corners).largest(), most * (1 + 1e-12));
  }
}

// Lets nothing happen above a height.
class BelowAPlane : public CollapseJudge {
 public:
  BelowAPlane(const TriangleSoup& mesh, double height) : points_(mesh.points), height_(height) {}
  bool allows(const Question& question) override {
    EXPECT_EQ(question.before.size(), question.after.size() + 2);
    for (const auto& triangle : question.after) EXPECT_EQ(triangle[0], question.point);
    return std::none_of(question.before.begin(), question.before.end(), [&](const auto& triangle) {
      return std::any_of(triangle.begin(), triangle.end(),
                         [&](std::uint32_t p) { return points_[p].z() > height_; });
    });
  }
  void note_made(const Question& question) override {
    points_[question.point] = question.place;
    ++made_;
  }
  [[nodiscard]] std::size_t made() const { return made_; }

 private:
  std::vector<Vec3d> points_;
  double height_;
  std::size_t made_ = 0;
};

TEST(Decimate, AJudgeIsAskedAndObeyed) {
  const TriangleSoup mesh = sphere(2000);
  BelowAPlane judge(mesh, 0);
  DecimationOptions options;
  options.judge = &judge;
  DecimationReport report;
  const DecimatedMesh few = decimate(mesh, options, report);
  expect_same_kind(mesh, few.mesh);
  EXPECT_EQ(judge.made(), report.collapses);
  EXPECT_LT(few.mesh.triangles.size(), mesh.triangles.size() * 6 / 10);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    if (mesh.points[p].z() <= 0) continue;
    EXPECT_EQ(few.mesh.points[few.point[p]], mesh.points[p]);
  }
}

TEST(Decimate, PointsThatAreToStayDo) {
  const TriangleSoup mesh = sphere(2000);
  std::vector<DecimationOptions::Stay> stays(mesh.points.size());
  for (std::size_t p = 0; p < stays.size(); p += 50) stays[p] = DecimationOptions::Stay::yes;
  DecimationOptions options;
  options.triangles = 4;
  options.stays = stays;
  DecimationReport report;
  const DecimatedMesh few = decimate(mesh, options, report);
  for (std::size_t p = 0; p < stays.size(); p += 50) {
    EXPECT_EQ(few.mesh.points[few.point[p]], mesh.points[p]);
  }
}

}  // namespace
}  // namespace meshrepair
