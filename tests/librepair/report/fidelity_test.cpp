// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <base/error.h>
#include <repair/fidelity.h>
#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

Fidelity fidelity_of(const TriangleSoup& soup, Precision precision = Precision::float64) {
  RepairOptions options;
  options.certify.precision = precision;
  return measure_fidelity(soup, repair(soup, options).surface, {precision, nullptr});
}

TEST(Fidelity, ASoundMeshIsKeptWhole) {
  const TriangleSoup soup = sphere(2000);
  const Fidelity f = fidelity_of(soup);
  EXPECT_EQ(f.kept_triangles, soup.triangles.size());
  EXPECT_DOUBLE_EQ(f.kept_area, surface_area(soup));
  EXPECT_LT(f.output_to_input.largest, 1e-15);
  ASSERT_TRUE(f.kept_to_output.has_value());
  EXPECT_LT(f.kept_to_output->largest, 1e-15);
  EXPECT_NEAR(f.diagonal, 2 * std::sqrt(3.0), 0.1);
}

// An open box: the lid that closes it is nowhere in the input.
TEST(Fidelity, WhereAHoleWasClosedTheOutputIsFar) {
  TriangleSoup soup;
  const TriangleSoup whole = cube();
  soup.points = whole.points;
  for (const auto& t : whole.triangles) {
    bool is_lid = true;
    for (const std::uint32_t p : t) is_lid = is_lid && whole.points[p].z() == 1;
    if (!is_lid) soup.triangles.push_back(t);
  }
  ASSERT_EQ(soup.triangles.size(), 10u);
  const Fidelity f = fidelity_of(soup);
  EXPECT_GT(f.output_to_input.largest, 0.4);
  EXPECT_LE(f.output_to_input.largest, 0.5);
  EXPECT_EQ(f.kept_triangles, 10u);
  EXPECT_LT(f.kept_to_output->largest, 1e-15);
}

// Of two cubes one of which is inside the other, and one triangle beside them that encloses
// nothing.
TEST(Fidelity, WhatIsLostIsNotKept) {
  TriangleSoup soup = cube();
  append(soup, box({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}));
  soup.points.insert(soup.points.end(), {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}});
  soup.triangles.push_back({16, 17, 18});
  const Fidelity f = fidelity_of(soup);
  EXPECT_EQ(f.kept_triangles, 12u);
  EXPECT_DOUBLE_EQ(f.kept_area, 6);
  EXPECT_LT(f.output_to_input.largest, 1e-15);
  EXPECT_LT(f.kept_to_output->largest, 1e-15);
}

TEST(Fidelity, TrianglesThatAreCutOffInPartAreNotKept) {
  const TriangleSoup soup = two_overlapping_spheres(600);
  const Fidelity f = fidelity_of(soup);
  EXPECT_GT(f.kept_triangles, 100u);
  EXPECT_LT(f.kept_triangles, soup.triangles.size());
  EXPECT_LT(f.kept_to_output->largest, 1e-12);
}

TEST(Fidelity, RoundingTakesNoTriangleAway) {
  const TriangleSoup soup = moved(sphere(2000), {100 / 3.0, 10 / 7.0, 1});
  const Fidelity f = fidelity_of(soup, Precision::float32);
  EXPECT_EQ(f.kept_triangles, soup.triangles.size());
  EXPECT_GT(f.kept_to_output->largest, 0);
  EXPECT_LT(f.kept_to_output->largest, 1e-5);
}

TEST(Fidelity, TrianglesThatAreNotFiniteAreLeftOut) {
  TriangleSoup soup = cube();
  soup.points.emplace_back(std::numeric_limits<double>::infinity(), 0, 0);
  soup.triangles.push_back({0, 1, 8});
  const Fidelity f = fidelity_of(soup);
  EXPECT_EQ(f.kept_triangles, 12u);
  EXPECT_DOUBLE_EQ(f.diagonal, std::sqrt(3.0));
  soup.triangles = {{0, 1, 8}};
  EXPECT_THROW((void)measure_fidelity(soup, {}), InputError);
}

// No source: nothing is kept, and there is no distance from it.
TEST(Fidelity, OfNothingKeptThereIsNoDistance) {
  Surface surface;
  surface.mesh = cube();
  surface.source.assign(12, Surface::kNoSource);
  const Fidelity f = measure_fidelity(cube(), surface);
  EXPECT_EQ(f.kept_triangles, 0u);
  EXPECT_EQ(f.kept_area, 0);
  EXPECT_FALSE(f.kept_to_output.has_value());
}

TEST(Fidelity, SamplesGrowWithTheMeshBetweenTwoLimits) {
  EXPECT_EQ(fidelity_samples(1), 1000u);
  EXPECT_EQ(fidelity_samples(20000), 20000u);
  EXPECT_EQ(fidelity_samples(1'000'000), 50000u);
}

class Impatient : public ProgressObserver {
 public:
  void stage(std::string_view /*name*/) override { ++stages; }
  void advance(double share) override {
    EXPECT_GE(share, last);
    last = share;
  }
  bool cancelled() override { return impatient; }
  int stages = 0;
  double last = 0;
  bool impatient = false;
};

TEST(Fidelity, MeasuringIsOneStageThatCanBeCancelled) {
  Surface surface;
  surface.mesh = sphere(20000);
  for (std::uint32_t t = 0; t < surface.mesh.triangles.size(); ++t) surface.source.push_back(t);
  Impatient observer;
  FidelityOptions options;
  options.progress = &observer;
  (void)measure_fidelity(surface.mesh, surface, options);
  EXPECT_EQ(observer.stages, 0);
  EXPECT_DOUBLE_EQ(observer.last, 1);
  observer.impatient = true;
  observer.last = 0;
  EXPECT_THROW((void)measure_fidelity(surface.mesh, surface, options), Cancelled);
}

}  // namespace
}  // namespace meshrepair
