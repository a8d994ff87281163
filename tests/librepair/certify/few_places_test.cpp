// SPDX-License-Identifier: MIT
// What is repaired again where it is: few places, each group of parts by itself.
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <check/self_intersections.h>
#include <mesh/mesh_parts.h>
#include <mesh/topology.h>
#include <repair/repair.h>

#include "certify/certification.h"
#include "shapes.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;

class FewPlaces : public ::testing::Test {
 protected:
  static constexpr CertifyOptions kSingle = {.precision = Precision::float32};

  static TriangleSoup crossing() {
    TriangleSoup soup = cube();
    append(soup, moved(cube(), {0.9375, 0.25, 0.125}));
    return soup;
  }

  internal::Certification certification(const CertifyOptions& options) {
    return {as_surface(crossing()), grid_, options, nullptr, report_};
  }

  CleanReport cleaned_;
  Grid grid_ = clean_soup(crossing(), cleaned_).grid;
  CertifyReport report_;
};

TEST_F(FewPlaces, PlacesAreRepairedWithoutMovingPoints) {
  internal::Certification few = certification(kSingle);
  few.mend_in_place();
  ASSERT_TRUE(few.are_few_places());
  const Surface& places = few.begin_places();
  EXPECT_EQ(places.mesh.points, crossing().points);
  RepairReport repaired;
  few.end_places(repair(places.mesh, {}, repaired));
  EXPECT_FALSE(few.are_few_places());
  const Surface result = few.result();
  EXPECT_TRUE(report_.passed());
  EXPECT_EQ(report_.rounds, 0u);
  EXPECT_LT(signed_volume(result.mesh), signed_volume(crossing()));
  EXPECT_EQ(self_intersections(result.mesh).count, 0u);
}

TEST_F(FewPlaces, PlacesAreLeftWhereRepairWasInVain) {
  internal::Certification few = certification(kSingle);
  few.mend_in_place();
  ASSERT_TRUE(few.are_few_places());
  few.end_places(Surface(few.begin_places()));
  EXPECT_FALSE(few.are_few_places());
  EXPECT_TRUE(few.may_go_on());
}

TEST_F(FewPlaces, PlacesGoOntoAGridWhereRepairWasInVain) {
  internal::Certification few = certification(kSingle);
  few.mend_in_place();
  ASSERT_TRUE(few.are_few_places());
  few.end_places(Surface(few.begin_places()));
  EXPECT_FALSE(few.are_few_places());
  ASSERT_TRUE(few.may_snap_places());
  RepairReport repaired;
  few.end_places(repair(few.begin_snapped_places().mesh, {}, repaired));
  EXPECT_FALSE(few.may_snap_places());
  const Surface result = few.result();
  EXPECT_TRUE(report_.passed());
  EXPECT_EQ(report_.rounds, 0u);
  EXPECT_EQ(self_intersections(result.mesh).count, 0u);
}

TEST_F(FewPlaces, PlacesAreLeftToRoundsWhereNoGridIsOfUse) {
  internal::Certification few = certification(kSingle);
  few.mend_in_place();
  std::size_t grids = 0;
  while (few.may_snap_places() && grids < 100) {
    few.end_places(Surface(few.begin_snapped_places()));
    ++grids;
  }
  EXPECT_EQ(grids, 3u);
  EXPECT_TRUE(few.may_go_on());
}

// As many as are too many elsewhere.
TEST_F(FewPlaces, LimitGrowsWithTheMesh) {
  TriangleSoup soup;
  for (int i = 0; i < 10; ++i) append(soup, moved(crossing(), {4.0 * i, 0, 0}));
  internal::Certification small(as_surface(soup), grid_, kSingle, nullptr, report_);
  small.mend_in_place();
  EXPECT_FALSE(small.are_few_places());
  append(soup, moved(sphere(300'000), {0, 10, 0}));
  internal::Certification large(as_surface(soup), grid_, kSingle, nullptr, report_);
  large.mend_in_place();
  EXPECT_TRUE(large.are_few_places());
}

TEST_F(FewPlaces, PlacesAreRepairedInSinglePrecisionAlone) {
  const CertifyOptions options;
  EXPECT_FALSE(certification(options).are_few_places());
}

// Each place is repaired by itself, and counted for itself.
class FaultyGroup : public FewPlaces {
 protected:
  template <class RepairAgain>
  Surface certified_by_groups(const TriangleSoup& soup, RepairAgain repair_again) {
    internal::Certification whole(as_surface(soup), grid_, kSingle, nullptr, report_);
    whole.mend_in_place();
    std::vector<Surface> groups = whole.take_faulty_groups();
    groups_ = groups.size();
    for (Surface& group : groups) {
      CertifyReport report;
      internal::Certification one(std::move(group), grid_, kSingle, nullptr, report);
      one.mend_in_place();
      while (one.are_few_places()) one.end_places(repair_again(one.begin_places().mesh));
      whole.give_back(one);
    }
    if (groups_ > 0) whole.end_groups();
    goes_on_ = whole.are_few_places() || whole.may_go_on();
    return whole.result();
  }

  static Surface repaired(const TriangleSoup& soup) {
    RepairReport report;
    return repair(soup, {}, report);
  }

  std::size_t groups_ = 0;
  bool goes_on_ = false;
};

TEST_F(FaultyGroup, IsRepairedWithoutTheOthers) {
  TriangleSoup soup = moved(sphere(300), {20, 0, 0});
  append(soup, crossing());
  append(soup, moved(cube(), {-20, 0, 0}));
  append(soup, moved(crossing(), {0, 20, 0}));
  std::vector<std::size_t> sizes;
  const auto note_size = [&](const TriangleSoup& group) {
    sizes.push_back(group.triangles.size());
    return repaired(group);
  };
  const Surface result = certified_by_groups(soup, note_size);
  EXPECT_EQ(sizes, std::vector(2, crossing().triangles.size()));
  EXPECT_TRUE(report_.passed());
  EXPECT_EQ(report_.rounds, 0u);
  EXPECT_EQ(self_intersections(result.mesh).count, 0u);
  EXPECT_EQ(find_parts(result.mesh).count, 4u);
  const double of_two = 2 - 0.0625 * 0.75 * 0.875;
  EXPECT_NEAR(signed_volume(result.mesh),
              signed_volume(soup) - 2 * signed_volume(crossing()) + 2 * of_two, 1e-3);
  for (const std::uint32_t source : result.source) EXPECT_LT(source, soup.triangles.size());
}

TEST_F(FaultyGroup, RepairInVainSpoilsNoOtherGroup) {
  TriangleSoup soup = crossing();
  append(soup, moved(cube(), {-20, 0, 0}));
  append(soup, moved(crossing(), {20, 0, 0}));
  const auto first_in_vain = [](const TriangleSoup& group) {
    return group.points.front().x() < 10 ? as_surface(group) : repaired(group);
  };
  const Surface result = certified_by_groups(soup, first_in_vain);
  EXPECT_EQ(groups_, 2u);
  EXPECT_FALSE(goes_on_);
  EXPECT_FALSE(report_.passed());
  EXPECT_EQ(report_.pairs, self_intersections(result.mesh).count);
  EXPECT_GT(report_.pairs, 0u);
  EXPECT_EQ(find_parts(result.mesh).count, 4u);
}

// What is inside out is known where nothing crosses any more.
TEST_F(FaultyGroup, LeavesWhatIsInsideOutElsewhereToBeFound) {
  TriangleSoup soup = crossing();
  append(soup, moved(cube(), {-20, 0, 0}));
  append(soup, moved(flipped(sphere(200)), {20, 0, 0}));
  (void)certified_by_groups(soup, repaired);
  EXPECT_EQ(report_.pairs, 0u);
  EXPECT_EQ(report_.inside_out_parts, 1u);
  EXPECT_FALSE(report_.passed());
}

// The cubes of the group, moved into a sound one: now it is about the whole.
TEST_F(FaultyGroup, MovedGroupIsTestedAgainstItsNeighbours) {
  TriangleSoup soup = moved(sphere(200), {20, 0, 0});
  append(soup, crossing());
  append(soup, moved(cube(), {-20, 0, 0}));
  const auto moves = [](const TriangleSoup&) {
    TriangleSoup there = moved(cube(), {20.5, 0.25, 0.125});
    append(there, moved(cube(), {5, 5, 5}));
    return as_surface(there);
  };
  CertifyReport report;
  internal::Certification whole(as_surface(soup), grid_, kSingle, nullptr, report_);
  whole.mend_in_place();
  for (Surface& group : whole.take_faulty_groups()) {
    internal::Certification one(std::move(group), grid_, kSingle, nullptr, report);
    one.mend_in_place();
    one.end_places(moves(one.begin_places().mesh));
    whole.give_back(one);
  }
  whole.end_groups();
  EXPECT_TRUE(whole.are_few_places());
  EXPECT_TRUE(whole.may_go_on());
  const Surface result = whole.result();
  EXPECT_GT(report_.pairs, 0u);
  EXPECT_EQ(report_.pairs, self_intersections(result.mesh).count);
}

TEST_F(FaultyGroup, SingleGroupIsNotTakenApart) {
  internal::Certification whole = certification(kSingle);
  whole.mend_in_place();
  EXPECT_TRUE(whole.take_faulty_groups().empty());
  EXPECT_TRUE(whole.are_few_places());
  EXPECT_TRUE(whole.may_go_on());
}

}  // namespace
}  // namespace meshrepair
