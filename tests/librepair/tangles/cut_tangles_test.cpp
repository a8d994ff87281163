// Meshes of which few triangles meet: cells are made around these alone, and what comes out is what
// the cells of all would have given.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <check/check_surface.h>
#include <repair/repair.h>

#include "open_surfaces.h"
#include "prepare/prepare.h"
#include "random_solids.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "surface/make_surface.h"
#include "triangles_by_place.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr std::size_t kScenes = 25;

// New points may differ in their last bits, as other planes meet there.
TriangleSoup rounded(TriangleSoup mesh) {
  for (Vec3d& p : mesh.points) p = (p * 0x1p30).array().round() * 0x1p-30;
  return mesh;
}

std::vector<std::array<double, 3>> places(const TriangleSoup& mesh) {
  std::vector<std::array<double, 3>> all;
  for (const Vec3d& p : mesh.points) all.push_back({p.x(), p.y(), p.z()});
  std::sort(all.begin(), all.end());
  return all;
}

// Where points lie on a circle, as they do on a lattice, polygons may be divided otherwise.
enum class Dividing { same, any };

void expect_same(const RepairResult& cut, const RepairResult& whole, Dividing dividing) {
  const TriangleSoup mesh = rounded(cut.surface.mesh), other = rounded(whole.surface.mesh);
  if (dividing == Dividing::same) {
    EXPECT_EQ(triangles_by_place(mesh), triangles_by_place(other));
  } else {
    EXPECT_EQ(mesh.triangles.size(), other.triangles.size());
    EXPECT_EQ(places(mesh), places(other));
  }
  const RepairReport& a = cut.report;
  const RepairReport& b = whole.report;
  EXPECT_EQ(a.inside.used, b.inside.used);
  EXPECT_EQ(a.inside.reason, b.inside.reason);
  EXPECT_EQ(a.inside.left_out_folds, b.inside.left_out_folds);
  EXPECT_EQ(a.triangles.untouched, b.triangles.untouched);
  EXPECT_EQ(a.triangles.cut, b.triangles.cut);
  EXPECT_EQ(a.parts.bounding_triangles, b.parts.bounding_triangles);
  EXPECT_EQ(a.parts.inside_triangles, b.parts.inside_triangles);
  EXPECT_EQ(a.parts.outside_triangles, b.parts.outside_triangles);
  EXPECT_EQ(a.parts.inside_solid.parts, b.parts.inside_solid.parts);
  EXPECT_EQ(a.parts.enclosing_nothing.parts, b.parts.enclosing_nothing.parts);
  EXPECT_EQ(a.output.parts, b.output.parts);
  EXPECT_NEAR(a.output_volume, b.output_volume, 1e-9 * std::abs(b.output_volume));
  EXPECT_NEAR(a.output_area, b.output_area, 1e-9 * b.output_area);
  EXPECT_NEAR(a.closing_area, b.closing_area, 1e-9 * b.output_area);
}

// By cells around tangles alone, if that way applies.
std::optional<RepairResult> repair_around_tangles(const TriangleSoup& soup, RepairOptions options) {
  RepairReport report;
  std::optional<Surface> surface;
  {
    StageMeter meter(report.stages, options.progress);
    const CleanSoup clean = internal::close_soup(soup, options, report, meter);
    const Orientation orientation = internal::orient_soup(clean, options, report, meter);
    internal::SavedStates states;
    surface = internal::surface_around_tangles(clean, orientation, options, states, report, meter);
  }
  if (!surface) return std::nullopt;
  return RepairResult{std::move(*surface), std::move(report)};
}

// Whether it applies; then the result is that of the whole work.
bool cuts_tangles(const TriangleSoup& soup, RepairOptions options,
                  Dividing dividing = Dividing::same) {
  std::optional<RepairResult> around;
  try {
    around = repair_around_tangles(soup, options);
  } catch (const NoSolidError&) {
    return false;
  }
  if (!around || around->report.set_aside == 0) return false;
  const RepairResult& cut = *around;
  EXPECT_TRUE(cut.report.certify.passed());
  options.all_cells = true;
  const RepairResult whole = repair(soup, options);
  // Once points are moved, in which direction is chance.
  if (whole.report.certify.pairs_at_first == 0 && cut.report.certify.pairs_at_first == 0) {
    expect_same(cut, whole, dividing);
  }
  EXPECT_NEAR(cut.report.output_volume, whole.report.output_volume,
              1e-6 * std::abs(whole.report.output_volume));
  return true;
}

// Each triangle in four, so many times.
TriangleSoup divided(TriangleSoup soup, int times) {
  for (; times > 0; --times) {
    TriangleSoup finer;
    for (const auto& t : soup.triangles) {
      const Vec3d &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
      const Vec3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
      for (const auto& [p, q, r] : {std::tuple(a, ab, ca), std::tuple(ab, b, bc),
                                    std::tuple(ca, bc, c), std::tuple(ab, bc, ca)}) {
        const auto first = static_cast<std::uint32_t>(finer.points.size());
        finer.points.insert(finer.points.end(), {p, q, r});
        finer.triangles.push_back({first, first + 1, first + 2});
      }
    }
    soup = std::move(finer);
  }
  return soup;
}

TriangleSoup random_shape(Random& random, std::uint64_t seed) {
  switch (random.integer(0, 3)) {
    case 0:
      return sphere(1000, random.real(0.5, 1.5));
    case 1:
      return torus(40, 20, random.real(1, 1.5), random.real(0.3, 0.6));
    case 2:
      return noisy_sphere(1000, 0.05, seed);
    default:
      return noisy_sphere(1000, 0.15, seed);
  }
}

TriangleSoup random_scene(std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  for (int i = random.integer(1, 4); i > 0; --i) {
    const TriangleSoup shape =
        transformed(random_shape(random, seed + 100), random_rotation(random));
    const Vec3d by(random.real(-2, 2), random.real(-2, 2), random.real(-2, 2));
    if (random.chance(0.2)) append(soup, moved(flipped(scaled(shape, 0.5)), by));
    append(soup, moved(shape, by));
  }
  return soup;
}

TEST(CutTangles, ScenesComeOutAsFromAllCells) {
  std::size_t cut = 0;
  for (std::uint64_t seed = 1; seed <= share_of_cases(kScenes); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    RepairOptions options;
    if (random.chance(0.2)) options.inside.rule = InsideRule::winding;
    if (random.chance(0.2)) options.extract.touching = Touching::join;
    TriangleSoup soup = random_scene(seed);
    if (random.chance(0.2)) soup = with_some_flipped(soup, 0.1, seed);
    if (random.chance(0.2)) soup = without_some(soup, 0.01, seed);
    cut += cuts_tangles(soup, options);
  }
  EXPECT_GT(cut, expected_cases(kScenes / 5));
}

// Coarse boxes with coordinates that are few: faces overlap, and edges and corners touch.
TEST(CutTangles, BoxesOnALatticeComeOutAsFromAllCells) {
  std::size_t cut = 0;
  for (std::uint64_t seed = 1; seed <= share_of_cases(kScenes); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriangleSoup soup;
    for (int i = random.integer(2, 4); i > 0; --i) {
      append(soup, divided(random_grid_boxes(1, 6, seed + static_cast<std::uint64_t>(i)), 3));
    }
    append(soup, moved(divided(cube(), 4), {20, 0, 0}));
    cut += cuts_tangles(soup, {}, Dividing::any);
  }
  EXPECT_GT(cut, expected_cases(kScenes / 5));
}

RepairOptions by_cells(RepairOptions options = {}) {
  options.all_cells = true;
  return options;
}

RepairResult repair_sparing(const TriangleSoup& soup, RepairOptions options = {}) {
  std::optional<RepairResult> around = repair_around_tangles(soup, options);
  if (around) return std::move(*around);
  return repair(soup, options);
}

TEST(CutTangles, SetsAsideWhatNothingMeets) {
  const TriangleSoup soup = two_overlapping_spheres(4000);
  const RepairResult result = repair_sparing(soup);
  EXPECT_GT(result.report.set_aside, soup.triangles.size() * 8 / 10);
  EXPECT_LT(result.report.set_aside, soup.triangles.size());
  EXPECT_LT(result.report.cells, repair(soup, by_cells()).report.cells / 2);
  EXPECT_EQ(result.report.triangles.untouched + result.report.triangles.cut +
                result.report.parts.inside_triangles,
            soup.triangles.size());
}

// Closed parts that nothing meets: inside, outside, in a cavity, around all.
TEST(CutTangles, PartsAloneAreInsideOrOutside) {
  TriangleSoup soup = two_overlapping_spheres(4000);
  append(soup, sphere(400, 0.1));
  append(soup, sphere(400, 0.1, {9, 0, 0}));
  EXPECT_TRUE(cuts_tangles(soup, {}));
  EXPECT_EQ(repair_sparing(soup).report.output.parts, 2u);
  append(soup, flipped(sphere(1000, 5)));
  append(soup, sphere(1000, 6));
  EXPECT_TRUE(cuts_tangles(soup, {}));
  EXPECT_EQ(repair_sparing(soup).report.output.parts, 4u);
  append(soup, sphere(1000, 20));
  EXPECT_TRUE(cuts_tangles(soup, {}));
}

// A fold that is no sliver is solid where it borders the outside, and empty in a cavity, which only
// cells farther away tell of.
TEST(CutTangles, PocketsInCavitiesAreLeftToAllCells) {
  const auto pushed_through = [](double radius) {
    TriangleSoup ball = sphere(1000, radius);
    for (Vec3d& p : ball.points) {
      if (p.x() > 0.97 * radius) p.x() -= 2.6 * radius;
    }
    return ball;
  };
  EXPECT_TRUE(cuts_tangles(pushed_through(1), {}));
  EXPECT_GT(repair_sparing(pushed_through(1)).report.output_volume,
            repair_sparing(sphere(1000)).report.output_volume * 0.8);
  TriangleSoup soup = pushed_through(1);
  append(soup, flipped(sphere(1000, 5)));
  append(soup, sphere(1000, 6));
  EXPECT_FALSE(cuts_tangles(soup, {}));
}

TEST(CutTangles, SolidsThatTouchAreSewnAsAsked) {
  TriangleSoup along_edge = divided(cube(), 3);
  append(along_edge, moved(divided(cube(), 3), {1, 1, 0.5}));
  TriangleSoup in_corner = divided(cube(), 3);
  append(in_corner, moved(divided(cube(), 3), {1, 1, 1}));
  TriangleSoup in_face = divided(cube(), 3);
  append(in_face, scaled(moved(divided(cube(), 3), {0.25, 0.25, 2}), 0.5));
  for (const Touching touching : {Touching::separate, Touching::join}) {
    RepairOptions options;
    options.extract.touching = touching;
    EXPECT_TRUE(cuts_tangles(along_edge, options, Dividing::any));
    EXPECT_TRUE(cuts_tangles(in_corner, options, Dividing::any));
    EXPECT_TRUE(cuts_tangles(in_face, options, Dividing::any));
  }
}

// Sheets nearer to each other than the numbers of a file: what lies between goes, also where one of
// them meets nothing else.
TEST(CutTangles, SlitsAreFilledAroundTangles) {
  constexpr double kGap = 0x1p-19;
  TriangleSoup soup = divided(cube(), 4);
  append(soup, flipped(box({0.25, 0.25, 0.5}, {0.75, 0.75, 0.5 + kGap})));
  append(soup, box({0.7, 0.7, 0.2}, {0.9, 0.9, 1.8}));
  RepairOptions options;
  options.certify.precision = Precision::float32;
  // Wherever the middle of all lies.
  for (const double x : {-16.0, 16.0}) {
    TriangleSoup scene = soup;
    append(scene, moved(scaled(divided(cube(), 4), 8), {x, 1, 2}));
    const RepairResult all = repair(scene, by_cells(options));
    ASSERT_GT(all.report.thin_cells.filled, 0u);
    const RepairResult result = repair_sparing(scene, options);
    EXPECT_GT(result.report.set_aside, 0u);
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_NEAR(result.report.slits_area, all.report.slits_area, 1e-4);
    EXPECT_NEAR(result.report.output_volume, all.report.output_volume, 1e-4);
    EXPECT_NEAR(result.report.output_area, all.report.output_area, 1e-4);
  }
}

// In double precision what meets nothing stays, and no more is divided for the sake of slits.
TEST(CutTangles, SlitsOfTheGridCostNoMoreAttempts) {
  constexpr double kGap = 0x1p-21;  // a step of the grid
  TriangleSoup soup = divided(cube(), 4);
  append(soup, flipped(box({0.25, 0.25, 0.5}, {0.75, 0.75, 0.5 + kGap})));
  append(soup, box({0.7, 0.7, 0.2}, {0.9, 0.9, 1.8}));
  append(soup, moved(scaled(divided(cube(), 5), 8), {16, 1, 2}));
  const RepairResult all = repair(soup, by_cells()), result = repair_sparing(soup);
  EXPECT_GT(all.report.thin_cells.filled, 0u);
  EXPECT_GT(result.report.set_aside, 0u);
  const std::vector<StageReport>& stages = result.report.stages;
  EXPECT_EQ(std::count_if(stages.begin(), stages.end(),
                          [](const StageReport& stage) { return stage.name == "tree"; }),
            1);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
  EXPECT_NEAR(result.report.output_volume, all.report.output_volume, 1e-5);
}

TEST(CutTangles, OtherRulesAskAllCells) {
  const TriangleSoup soup = two_overlapping_spheres(4000);
  RepairOptions options;
  EXPECT_TRUE(cuts_tangles(soup, options));
  options.inside.rule = InsideRule::winding;
  EXPECT_TRUE(cuts_tangles(soup, options));
  for (const InsideRule rule : {InsideRule::parity, InsideRule::solidity}) {
    options.inside.rule = rule;
    EXPECT_FALSE(cuts_tangles(soup, options));
  }
  options.inside = {};
  options.inside.cavities = Cavities::fill;
  EXPECT_FALSE(cuts_tangles(soup, options));
}

TEST(CutTangles, IsCertifiedInSinglePrecision) {
  RepairOptions options;
  options.certify.precision = Precision::float32;
  options.certify.welded = true;
  for (std::uint64_t seed = 1; seed <= share_of_cases(8u); ++seed) {
    SCOPED_TRACE(seed);
    const RepairResult result = repair_sparing(random_scene(seed), options);
    if (result.report.set_aside == 0) continue;
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
  }
}

}  // namespace
}  // namespace meshrepair
