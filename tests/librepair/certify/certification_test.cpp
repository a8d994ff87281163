// SPDX-License-Identifier: MIT
#include "certify/certification.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <check/check_surface.h>
#include <check/self_intersections.h>
#include <mesh/precision.h>
#include <mesh/soup_io.h>
#include <repair/repair.h>

#include "complexes.h"
#include "degenerate_soups.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;

Surface no_repair(const TriangleSoup& soup) { return as_surface(soup); }

// All that can be asked of it, with another way to repair what comes of a round.
template <class RepairAgain>
Surface certified(const Surface& surface, const CertifyOptions& options, RepairAgain repair_again,
                  CertifyReport& report) {
  CleanReport cleaned;
  const Grid grid = clean_soup(surface.mesh, cleaned).grid;
  internal::Certification certification(surface, grid, options, nullptr, report);
  if (certification.may_settle()) certification.settle();
  certification.mend_in_place();
  while (certification.may_go_on()) {
    certification.end_round(repair_again(certification.begin_round().mesh));
  }
  return certification.result();
}

Surface certified(const Surface& surface, const CertifyOptions& options, CertifyReport& report) {
  return certified(surface, options, no_repair, report);
}

TEST(PairsByChance, GrowWithLargeMeshesAlone) {
  EXPECT_EQ(pairs_by_chance(0), 32u);
  EXPECT_EQ(pairs_by_chance(200'000), 32u);
  EXPECT_EQ(pairs_by_chance(262'144), 32u);
  EXPECT_EQ(pairs_by_chance(2'000'000), 6820u);
}

TEST(Certify, LeavesASoundSurfaceAsItIs) {
  CertifyReport report;
  const TriangleSoup soup = sphere(300);
  const Surface result = certified(as_surface(soup), {}, report);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.rounds, 0u);
  EXPECT_EQ(result.mesh.triangles, soup.triangles);
  EXPECT_EQ(result.mesh.points, soup.points);
}

TEST(Certify, SaysWhatCannotBeMended) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {0.5, 0.25, 0.125}));
  CertifyReport report;
  const Surface result = certified(as_surface(soup), {}, report);
  EXPECT_TRUE(report.done);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.pairs_at_first, report.pairs);
  EXPECT_EQ(report.pairs, self_intersections(result.mesh).count);
}

TEST(Certify, LosesNoSolidToACoarserGrid) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {0.5, 0.25, 0.125}));
  CertifyReport report;
  const auto scrap = [](const TriangleSoup&) { return as_surface(scaled(cube(), 0.01)); };
  const Surface result = certified(as_surface(soup), {}, scrap, report);
  EXPECT_FALSE(report.passed());
  EXPECT_NEAR(signed_volume(result.mesh), 2, 1e-6);
}

TEST(Certify, MovesNothingWhenNoRoundsAreAllowed) {
  TriangleSoup soup = box({-1, -1, -1}, {1, 1, 1.0 / 3});
  append(soup, moved(cube(), {0.5, 0.25, 1.0 / 3}));
  CertifyOptions options;
  options.most_rounds = 0;
  CertifyReport report;
  const Surface result = certified(as_surface(soup), options, report);
  EXPECT_FALSE(report.passed());
  EXPECT_GT(report.pairs, 0u);
  EXPECT_EQ(report.pairs, report.pairs_at_first);
  EXPECT_EQ(result.mesh.points, soup.points);
  EXPECT_EQ(result.mesh.triangles, soup.triangles);
}

// A corner just above a face, rounded onto it.
TEST(Certify, MovesNothingWhereTooManyMeetAtFirst) {
  TriangleSoup soup = box({-1, -1, -1}, {1, 1, 1.0 / 3});
  append(soup, moved(cube(), {0.5, 0.25, 1.0 / 3}));
  CertifyOptions options;
  options.precision = Precision::float32;
  CertifyReport report;
  (void)certified(as_surface(soup), options, report);
  ASSERT_GT(report.pairs_at_first, 0u);
  options.most_pairs_at_first = report.pairs_at_first - 1;
  const Surface result = certified(as_surface(soup), options, report);
  EXPECT_EQ(report.pairs, report.pairs_at_first);
  EXPECT_EQ(report.rounds, 0u);
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    EXPECT_EQ(result.mesh.points[i], rounded_to_float32(soup.points[i]));
  }
}

TEST(Certify, NudgesPointsOffTheFacesThatTheyFellOn) {
  TriangleSoup soup = box({-1, -1, -1}, {1, 1, 1.0 / 3});
  TriangleSoup tip;
  tip.points = {{0.1, 0.2, 1.0 / 3}, {0.5, 0, 2}, {-0.5, 0.4, 2}, {-0.4, -0.5, 2}};
  tip.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  append(soup, tip);
  Surface surface = as_surface(soup);
  surface.input_point[first] = 0;
  ASSERT_GT(self_intersections(soup).count, 0u);
  CertifyReport report;
  const Surface result = certified(surface, {}, report);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.rounds, 0u);
  EXPECT_EQ(self_intersections(result.mesh).count, 0u);
  EXPECT_LT((result.mesh.points[first] - tip.points[0]).norm(), 1e-13);
}

// Facing inward and too thin for the numbers to tell.
TriangleSoup inverted_sliver() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 0x1p-50}},
          {{{0, 1, 2}}, {{0, 3, 1}}, {{1, 3, 2}}, {{2, 3, 0}}}};
}

TEST(Certify, DropsThinPartsThatFaceTheWrongWay) {
  TriangleSoup soup = moved(cube(), {2, 0, 0});
  append(soup, inverted_sliver());
  CertifyReport report;
  const Surface result = certified(as_surface(soup), {}, report);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.dropped_parts, 1u);
  EXPECT_TRUE(check_surface(result.mesh).valid_solid());
  EXPECT_EQ(result.mesh.triangles.size(), 12u);
  EXPECT_EQ(result.source.size(), 12u);
}

// So many of the parts, which are boxes, go; the rest passes without a round of mending.
void expect_dropped(const TriangleSoup& soup, std::size_t parts) {
  ASSERT_GT(self_intersections(soup).count, 0u);
  CertifyReport report;
  const Surface result = certified(as_surface(soup), {}, report);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.dropped_parts, parts);
  EXPECT_NEAR(report.dropped_share, 1 - surface_area(result.mesh) / surface_area(soup), 1e-12);
  EXPECT_GT(report.dropped_share, 0);
  EXPECT_EQ(report.rounds, 0u);
  EXPECT_EQ(result.mesh.triangles.size(), soup.triangles.size() - 12 * parts);
  EXPECT_EQ(result.source.size(), result.mesh.triangles.size());
}

// Two that cross, as thin as the numbers are apart: moving their points would not end it.
TEST(Certify, DropsPartsAtFaultThatAreAsThinAsTheNumbersAreApart) {
  TriangleSoup soup = moved(cube(), {4, 0, 0});
  append(soup, box({2, 0, 1}, {3, 1, 1 + 0x1p-52}));
  append(soup, box({2.25, -1, 1}, {2.75, 2, 1 + 0x1p-52}));
  expect_dropped(soup, 2);
}

// Those beside it that are thin too, but not at fault, stay, as does the thick one.
TEST(Certify, DropsOnlyThinPartsThatAreAtFault) {
  TriangleSoup soup = moved(cube(), {4, 0, 0});
  append(soup, box({2, 0, 1}, {3, 1, 1 + 0x1p-52}));
  append(soup, box({4.25, 0.25, 0.5}, {6, 0.75, 0.5 + 0x1p-52}));
  expect_dropped(soup, 1);
}

TEST(Certify, TurnsThinPartsThatFaceTheWrongWayWhereThereIsNothingElse) {
  CertifyReport report;
  const Surface result = certified(as_surface(inverted_sliver()), {}, report);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.dropped_parts, 0u);
  EXPECT_TRUE(check_surface(result.mesh).valid_solid());
}

TEST(Certify, SaysThatAThickPartFacesTheWrongWay) {
  TriangleSoup soup = cube();
  append(soup, flipped(moved(cube(), {2, 0, 0})));
  CertifyReport report;
  const Surface result = certified(as_surface(soup), {}, report);
  EXPECT_TRUE(report.done);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.inside_out_parts, 1u);
  EXPECT_EQ(report.dropped_parts, 0u);
  EXPECT_EQ(result.mesh.triangles.size(), 24u);
}

// Repairing again would unite it with what is around, and hide it.
TEST(Certify, DoesNotRepairAgainBecauseAPartFacesTheWrongWay) {
  TriangleSoup soup = box({0, 0, 0}, {4, 4, 4});
  append(soup, box({1, 1, 1}, {2, 2, 2}));
  CertifyReport report;
  std::size_t repairs = 0;
  const auto count = [&](const TriangleSoup& again) {
    ++repairs;
    return as_surface(again);
  };
  (void)certified(as_surface(soup), {}, count, report);
  EXPECT_EQ(repairs, 0u);
  EXPECT_EQ(report.inside_out_parts, 1u);
  EXPECT_FALSE(report.passed());
}

// Dropping what is around turns outside and inside about.
TEST(Certify, LooksAgainAtWhatIsInADroppedPart) {
  TriangleSoup soup = moved(cube(), {2, 0, 0});
  append(soup, inverted_sliver());
  TriangleSoup wall = inverted_sliver();
  for (Vec3d& p : wall.points) p = Vec3d(0.3, 0.3, 0x1p-53) + p.cwiseProduct(Vec3d(0.1, 0.1, 0.01));
  append(soup, wall);
  CertifyReport report;
  const Surface result = certified(as_surface(soup), {}, report);
  EXPECT_TRUE(report.passed());
  EXPECT_TRUE(check_surface(result.mesh).valid_solid());
}

TEST(Certify, LosesNoPartToTheRangeOfDoubles) {
  TriangleSoup soup = sphere(200);
  append(soup, moved(scaled(sphere(100), 1e-3), {1.5, 0, 0}));
  for (const double scale : {1e104, 1e-106}) {
    CertifyReport report;
    const Surface result = certified(as_surface(scaled(soup, scale)), {}, report);
    EXPECT_TRUE(report.passed());
    EXPECT_EQ(report.dropped_parts, 0u);
    EXPECT_EQ(result.mesh.triangles.size(), soup.triangles.size());
  }
}

TEST(Certify, KnowsCavitiesFromPartsThatFaceTheWrongWay) {
  TriangleSoup soup = cube();
  append(soup, flipped(box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})));
  CertifyReport report;
  (void)certified(as_surface(soup), {}, report);
  EXPECT_TRUE(report.passed());
  (void)certified(as_surface(flipped(soup)), {}, report);
  EXPECT_EQ(report.inside_out_parts, 2u);
}

// Outward on the working grid, inward with the coordinates that are written.
TEST(Certify, PartsThinnerThanTheGridFaceOutward) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {0.5, 0.5, 0.5}));
  append(soup, {{{2.5081722740751675, 2.507611432376327, 2.3310263058714513},
                 {2.3053153145270384, 2.0891390237203473, 2.5021949650502648},
                 {2.8306086442236915, 2.8668177844750513, 2.4147015896881228},
                 {2.5762897387212793, 2.5257522472903715, 2.4158470142890671}},
                {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}});
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    RepairOptions options;
    options.certify.precision = precision;
    const RepairResult result = repair(soup, options);
    EXPECT_EQ(result.report.certify.dropped_parts, 1u);
    EXPECT_EQ(result.report.output.parts, 1u);
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
  }
}

Surface certified_for_stl(const TriangleSoup& soup, CertifyReport& report) {
  CertifyOptions options;
  options.precision = Precision::float32;
  options.welded = true;
  return certified(as_surface(soup), options, report);
}

TEST(Certify, MovesTouchingSolidsApartForFormatsThatJoinPoints) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {1, 1, 0}));  // along an edge
  append(soup, moved(cube(), {2, 2, 1}));  // in a corner
  CertifyReport report;
  const Surface result = certified_for_stl(soup, report);
  EXPECT_TRUE(report.passed());
  const TriangleSoup back = as_read_back(result.mesh, SoupFormat::stl_binary);
  expect_closed_manifold(back);
  EXPECT_EQ(back.points.size(), 24u);
  EXPECT_NEAR(signed_volume(back), 3, 1e-5);
}

TEST(Certify, PointsThatAreMovedApartAreNoneOfTheInput) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {1, 1, 0}));  // along an edge
  CertifyReport report;
  const Surface result = certified_for_stl(soup, report);
  ASSERT_TRUE(report.passed());
  std::size_t moved_points = 0;
  for (std::size_t p = 0; p < result.mesh.points.size(); ++p) {
    const auto& all = soup.points;
    const bool is_there = std::find(all.begin(), all.end(), result.mesh.points[p]) != all.end();
    moved_points += is_there ? 0 : 1;
    EXPECT_EQ(result.input_point[p] != 0, is_there);
  }
  EXPECT_GT(moved_points, 0u);
}

// As a reader of binary STL gets it back. No second repair is needed, and no points are welded.
TriangleSoup repaired_as_stl(const TriangleSoup& soup, Touching touching) {
  RepairOptions options;
  options.extract.touching = touching;
  options.certify.precision = Precision::float32;
  options.certify.welded = true;
  const RepairResult result = repair(soup, options);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_EQ(result.report.certify.rounds, 0u);
  TriangleSoup back = as_read_back(result.surface.mesh, SoupFormat::stl_binary);
  EXPECT_EQ(back.points.size(), result.surface.mesh.points.size());
  return back;
}

// Whether it is a cavity or a solid that has a tip on a face, the tip has to go back into what it
// is the tip of.
TEST(Certify, MovesTipsOfCavitiesOffTheFacesThatTheyTouch) {
  const TriangleSoup tetrahedron = {
      {{0.3, 0.4, 1}, {0.2, 0.2, 0.5}, {0.7, 0.2, 0.4}, {0.4, 0.8, 0.6}},
      {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
  TriangleSoup soup = cube();
  append(soup, signed_volume(tetrahedron) > 0 ? flipped(tetrahedron) : tetrahedron);
  const TriangleSoup back = repaired_as_stl(soup, Touching::separate);
  EXPECT_TRUE(check_surface(back).valid_solid());
  EXPECT_NEAR(signed_volume(back), 1 - std::abs(signed_volume(tetrahedron)), 1e-5);
}

// Two cubes joined along an edge are one solid still when a reader of STL welds their corners.
TEST(Certify, WidensJoinedEdgesForFormatsThatJoinPoints) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {1, 1, 0}));  // along an edge
  append(soup, moved(cube(), {2, 2, 1}));  // in a corner
  const TriangleSoup back = repaired_as_stl(soup, Touching::join);
  expect_closed_manifold(back);
  const Topology t = examine_topology(back.triangles, back.points.size());
  EXPECT_EQ(t.parts, 2u);
  EXPECT_NEAR(signed_volume(back), 3, 1e-5);
}

TEST(Certify, DropsPartsThatRoundingFlattens) {
  TriangleSoup soup = cube();
  append(soup, box({2, 2, 2}, {2.5, 2.5, 2 + 1e-9}));
  CertifyOptions options;
  options.precision = Precision::float32;
  CertifyReport report;
  const Surface result = certified(as_surface(soup), options, report);
  EXPECT_EQ(report.dropped_parts, 1u);
  EXPECT_EQ(result.mesh.triangles.size(), 12u);
  EXPECT_EQ(result.mesh.points.size(), 8u);
  EXPECT_TRUE(report.passed());
}

// Rounded to float32 two boxes each have a common face. These are too many to be mended place by
// place.
TriangleSoup many_crossing_cubes() {
  TriangleSoup soup;
  const TriangleSoup small = box({0, 0, 0}, {1.0 / 32, 1.0 / 32, 1.0 / 32});
  for (int i = 0; i < 512; ++i) {
    const Vec3d at = Vec3d(i % 8 + 8, i / 8 % 8, i / 64) / 8;
    append(soup, moved(small, at));
    append(soup, moved(small, at + Vec3d(1.0 / 32 + 5e-8, 1.0 / 64, 1.0 / 128)));
  }
  return soup;
}

TEST(Certify, TakesNoRoundsWhereEachGroupHasFewPlaces) {
  RepairOptions options;
  options.certify.precision = Precision::float32;
  const RepairResult result = repair(many_crossing_cubes(), options);
  EXPECT_GT(result.report.certify.pairs_at_first, 0u);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_EQ(result.report.certify.rounds, 0u);
}

// Shares of the stage that certifies.
class SharesOfCertify : public ProgressObserver {
 public:
  void stage(std::string_view name) override { is_certify_ = name == "certify"; }
  void advance(double share) override {
    if (is_certify_) shares.push_back(share);
  }
  std::vector<double> shares;

 private:
  bool is_certify_ = false;
};

TEST(Certify, TellsOfEachGroupHowFarItIs) {
  SharesOfCertify observer;
  RepairOptions options;
  options.certify.precision = Precision::float32;
  options.progress = &observer;
  options.all_cells = true;
  options.simplify = 0;
  ASSERT_TRUE(repair(many_crossing_cubes(), options).report.certify.passed());
  const std::vector<double>& shares = observer.shares;
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares.size(), 512u);
  EXPECT_LT(shares.back(), 1);
}

// In a shell they are one group, and all is repaired again.
TEST(Certify, SourcesAreThoseOfTheFirstInput) {
  TriangleSoup soup = many_crossing_cubes();
  append(soup, box({0.5, -0.5, -0.5}, {2.5, 1.5, 1.5}));
  append(soup, flipped(box({0.75, -0.25, -0.25}, {2.25, 1.25, 1.25})));
  RepairOptions options;
  options.certify.precision = Precision::float32;
  const RepairResult result = repair(soup, options);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_GT(result.report.certify.rounds, 0u);
  const TriangleSoup& mesh = result.surface.mesh;
  ASSERT_EQ(result.surface.source.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    ASSERT_NE(result.surface.source[t], Surface::kNoSource);
    const auto& from = soup.triangles.at(result.surface.source[t]);
    const Vec3d& a = soup.points[from[0]];
    const Vec3d normal = (soup.points[from[1]] - a).cross(soup.points[from[2]] - a).normalized();
    for (const std::uint32_t p : mesh.triangles[t]) {
      EXPECT_NEAR(normal.dot(mesh.points[p] - a), 0, 1e-6);
    }
  }
}

// Whatever goes in, the numbers that come out bound a solid.
TEST(Certify, RepairsOfDegenerateSoupsPass) {
  for (const SoupFamily& family : degenerate_families()) {
    for (std::uint64_t seed = 0; seed < share_of_cases(6u); ++seed) {
      SCOPED_TRACE(family.name + " " + std::to_string(seed));
      RepairReport report;
      RepairOptions options;
      options.extract.touching = seed % 2 == 0 ? Touching::separate : Touching::join;
      try {
        const Surface surface = repair(family.make(seed), options, report);
        EXPECT_TRUE(report.certify.passed());
        EXPECT_EQ(self_intersections(surface.mesh).count, 0u);
        EXPECT_EQ(surface.source.size(), surface.mesh.triangles.size());
        EXPECT_EQ(surface.input_point.size(), surface.mesh.points.size());
        expect_closed_manifold(surface.mesh);
      } catch (const NoSolidError&) {
        EXPECT_EQ(report.inside.solid_cells, 0u);
      }
    }
  }
}

}  // namespace
}  // namespace meshrepair
