// SPDX-License-Identifier: MIT
// Openings that a ball cannot pass are closed, others are not.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/internal/triangle_measures.h>
#include <mesh/topology.h>
#include <repair/repair.h>
#include <repair/seal_openings.h>

#include "random_geometry.h"
#include "revolved.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr double kBall = 4 * std::numbers::pi / 3;

RepairResult sealed(const TriangleSoup& soup, double size) {
  RepairOptions options;
  options.seal = {.size = size, .most_cubes = std::size_t{1} << 20};
  return repair(soup, options);
}

// Inner diameters of 1.8 and 0.56; a cup that is not as deep as wide.
const Profile kMug = {{0, 0}, {1, 0}, {1, 2}, {0.9, 2}, {0.9, 0.1}, {0, 0.1}};
const Profile kBottle = {{0, 0},      {1, 0},       {1, 2},       {0.35, 2.6}, {0.35, 3.2},
                         {0.28, 3.2}, {0.28, 2.55}, {0.92, 1.95}, {0.92, 0.1}, {0, 0.1}};
const Profile kDish = {{0, 0}, {1, 0}, {1, 0.5}, {0.9, 0.5}, {0.9, 0.1}, {0, 0.1}};

std::set<std::array<double, 9>> triangles_at(const TriangleSoup& soup) {
  std::set<std::array<double, 9>> all;
  for (const auto& t : soup.triangles) {
    std::array<double, 9> at{};
    // From the corner that comes first, so that it does not matter which one the list begins with.
    std::size_t first = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      const Vec3d &a = soup.points[t[k]], &b = soup.points[t[first]];
      if (std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end())) first = k;
    }
    for (std::size_t i = 0; i < 9; ++i) {
      at[i] = soup.points[t[(first + i / 3) % 3]][static_cast<Eigen::Index>(i % 3)];
    }
    all.insert(at);
  }
  return all;
}

TEST(SealOpenings, APinholeMakesAFullBall) {
  for (const double hole : {0.06, 0.1}) {
    const TriangleSoup shell = pierced_shell(hole, 0.1, 64);
    const RepairResult result = sealed(shell, 3 * hole);
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_EQ(result.report.seal.openings, 1u);
    EXPECT_NEAR(signed_volume(result.surface.mesh) / kBall, 1, 0.005) << hole;
    // Of the outer wall all is there but what is at the hole.
    const auto given = triangles_at(shell), made = triangles_at(result.surface.mesh);
    std::size_t outer = 0, kept = 0;
    for (const auto& t : given) {
      const bool is_outer = std::hypot(t[0], t[1], t[2]) > 0.999 &&
                            std::hypot(t[3], t[4], t[5]) > 0.999 &&
                            std::hypot(t[6], t[7], t[8]) > 0.999;
      outer += is_outer ? 1 : 0;
      kept += is_outer && made.contains(t) ? 1 : 0;
    }
    EXPECT_EQ(kept, outer) << hole;
  }
}

TEST(SealOpenings, WhatABallPassesStaysAsItIs) {
  for (const double hole : {0.2}) {
    const TriangleSoup shell = pierced_shell(hole, 0.1, 64);
    const RepairResult result = sealed(shell, 1.5 * hole);
    EXPECT_EQ(result.report.seal.openings, 0u);
    EXPECT_EQ(result.surface.mesh.triangles, shell.triangles);
  }
}

TEST(SealOpenings, VesselsAreFilledWhenTheirMouthIsTooSmall) {
  const TriangleSoup mug = revolved(kMug, 48), bottle = revolved(kBottle, 48);
  EXPECT_EQ(sealed(mug, 1.7).report.seal.openings, 0u);
  EXPECT_EQ(sealed(bottle, 0.5).report.seal.openings, 0u);
  for (const double size : {2.2, 3.0, 20.0}) {
    const double volume = signed_volume(sealed(mug, size).surface.mesh);
    EXPECT_GT(volume, 4) << size;
    EXPECT_LT(volume, 2 * std::numbers::pi) << size;
  }
  for (const double size : {0.65, 4.0}) {
    // Somewhere in the neck, which holds 0.15.
    EXPECT_NEAR(signed_volume(sealed(bottle, size).surface.mesh), 7.33, 0.08) << size;
  }
}

// Edges and corners, concave by 90 degrees, and a dish that is wider than deep.
TEST(SealOpenings, FilletsAndDishesStay) {
  TriangleSoup stairs = box({0, 0, 0}, {3, 3, 1});
  append(stairs, box({0, 0, 0}, {3, 1, 2}));
  append(stairs, box({0, 0, 0}, {1, 3, 3}));
  const RepairResult united = sealed(stairs, 0);
  for (const double size : {0.5, 2.0}) {
    EXPECT_EQ(sealed(united.surface.mesh, size).report.seal.openings, 0u) << size;
    EXPECT_EQ(sealed(revolved(kDish, 48), size).report.seal.openings, 0u) << size;
  }
}

// Another place on the grid, the same decision.
TEST(SealOpenings, TurningAShapeChangesNoDecision) {
  Random random(5);
  const TriangleSoup shell = pierced_shell(0.1, 0.1, 48), bottle = revolved(kBottle, 32),
                     mug = revolved(kMug, 32);
  const std::size_t turns = share_of_cases(std::size_t{4});
  for (std::size_t i = 0; i < turns; ++i) {
    const Eigen::Matrix3d turn = random_rotation(random);
    const auto made = [&](const TriangleSoup& soup, double size) {
      const RepairResult result = sealed(transformed(soup, turn), size);
      EXPECT_TRUE(result.report.certify.passed());
      EXPECT_EQ(result.report.seal.leaks, 0u);
      return result;
    };
    EXPECT_NEAR(signed_volume(made(shell, 0.27).surface.mesh) / kBall, 1, 0.01);
    EXPECT_EQ(made(shell, 0.15).report.seal.openings, 0u);
    EXPECT_NEAR(signed_volume(made(bottle, 0.7).surface.mesh), 7.3, 0.15);
    EXPECT_EQ(made(bottle, 0.48).report.seal.openings, 0u);
    EXPECT_NEAR(signed_volume(made(mug, 1.95).surface.mesh), 4.7, 0.7);
    EXPECT_EQ(made(mug, 1.6).report.seal.openings, 0u);
  }
}

// Behind the front that cubes see, a wall may pass between their centres.
TEST(SealOpenings, WallsAskewToTheGridLeakNothing) {
  Random random(17);
  const std::size_t cases = share_of_cases(std::size_t{6});
  for (std::size_t i = 0; i < cases; ++i) {
    const double wall = random.real(0.02, 0.12), hole = random.real(0.05, 0.15);
    const TriangleSoup shell = transformed(pierced_shell(hole, wall, 32), random_rotation(random));
    const RepairResult result = sealed(shell, 2.6 * hole);
    EXPECT_EQ(result.report.seal.leaks, 0u) << i;
    EXPECT_EQ(result.report.output.parts, 1u) << i;
    EXPECT_GT(signed_volume(result.surface.mesh), 0.97 * kBall) << i;
  }
}

TEST(SealOpenings, WhatStaysKeepsItsSource) {
  const TriangleSoup shell = pierced_shell(0.1, 0.1, 48);
  const Surface surface = sealed(shell, 0.27).surface;
  std::size_t whole = 0, patch = 0;
  for (std::size_t t = 0; t < surface.source.size(); ++t) {
    const std::uint32_t source = surface.source[t];
    if (source == Surface::kNoSource) {
      ++patch;
      continue;
    }
    ASSERT_LT(source, shell.triangles.size());
    const auto &made = surface.mesh.triangles[t], &given = shell.triangles[source];
    const Vec3d& corner = surface.mesh.points[made[0]];
    const bool is_same = std::any_of(given.begin(), given.end(),
                                     [&](std::uint32_t p) { return shell.points[p] == corner; });
    whole += is_same ? 1 : 0;
  }
  EXPECT_GT(whole, shell.triangles.size() / 3);
  EXPECT_GT(patch, 0u);
}

TEST(SealOpenings, WhatIsSolidAlreadyIsKeptAsGiven) {
  const RepairResult result = sealed(sphere(500), 0.3);
  EXPECT_TRUE(result.report.kept_valid);
  EXPECT_EQ(result.report.seal.openings, 0u);
}

TEST(SealOpenings, SeveralHolesAreClosedOneByOne) {
  TriangleSoup two = pierced_shell(0.06, 0.1, 48);
  append(two, moved(pierced_shell(0.15, 0.1, 48), {3, 0, 0}));
  const RepairResult small = sealed(two, 0.2);
  EXPECT_EQ(small.report.seal.openings, 1u);
  const RepairResult both = sealed(two, 0.45);
  EXPECT_EQ(both.report.seal.openings, 2u);
  EXPECT_NEAR(signed_volume(both.surface.mesh) / kBall, 2, 0.02);
}

TEST(SealOpenings, SoupIsRepairedBeforeItIsSealed) {
  TriangleSoup shell = pierced_shell(0.05, 0.1, 48);
  append(shell, moved(sphere(500, 0.3), {1, 0, 0}));
  shell = with_some_flipped(std::move(shell), 0.1, 3);
  const RepairResult result = sealed(shell, 0.15);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_GT(signed_volume(result.surface.mesh), 0.99 * kBall);
}

// However far away and how large another body is.
TEST(SealOpenings, BodiesFarApartAreSealedOneByOne) {
  TriangleSoup far = pierced_shell(0.06, 0.1, 48);
  append(far, moved(sphere(500, 3), {100, 20, -7}));
  const double rest = signed_volume(sphere(500, 3));
  RepairOptions options;
  options.explain = true;
  for (const bool automatic : {false, true}) {
    options.seal = {.size = automatic ? 0 : 0.2, .automatic = automatic};
    const RepairResult result = repair(far, options);
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_EQ(result.report.seal.openings, 1u);
    EXPECT_EQ(result.report.output.parts, 2u);
    EXPECT_NEAR(signed_volume(result.surface.mesh) - rest, kBall, 0.01 * kBall);
    const auto& origins = result.report.explanation.origins;
    ASSERT_EQ(origins.size(), result.surface.mesh.triangles.size());
    EXPECT_TRUE(std::any_of(origins.begin(), origins.end(),
                            [](TriangleOrigin o) { return o == TriangleOrigin::seal; }));
  }
}

TEST(SealOpenings, ScalingByAPowerOfTwoScalesTheResult) {
  const TriangleSoup shell = pierced_shell(0.06, 0.1, 32);
  const RepairResult one = sealed(shell, 0.2);
  for (const int exponent : {-300, -80, 72, 300}) {
    const double scale = std::ldexp(1.0, exponent);
    TriangleSoup soup = shell;
    for (Vec3d& p : soup.points) p *= scale;
    const RepairResult result = sealed(soup, 0.2 * scale);
    EXPECT_EQ(result.report.seal.openings, 1u) << exponent;
    EXPECT_EQ(result.report.seal.step, one.report.seal.step * scale) << exponent;
    ASSERT_EQ(result.surface.mesh.triangles, one.surface.mesh.triangles) << exponent;
    for (std::size_t p = 0; p < one.surface.mesh.points.size(); ++p) {
      ASSERT_EQ(result.surface.mesh.points[p], one.surface.mesh.points[p] * scale) << exponent;
    }
  }
}

// Around narrow places alone, as all space would take too many cubes.
TEST(SealOpenings, PinholesOfAThousandthAreClosed) {
  for (const double hole : {0.001, 0.004, 0.02}) {
    const TriangleSoup shell = pierced_shell(hole, 0.03, 64);
    EXPECT_EQ(sealed(shell, 1.5 * hole).report.seal.openings, 0u) << hole;
    for (const double size : {3 * hole, 5 * hole}) {
      const RepairResult full = sealed(shell, size);
      EXPECT_EQ(full.report.seal.openings, 1u) << hole;
      EXPECT_EQ(full.report.seal.leaks, 0u) << hole;
      EXPECT_NEAR(signed_volume(full.surface.mesh) / kBall, 1, 0.005) << hole;
    }
  }
}

// Also where the middle of a larger grid's cube at the mouth is behind the wall, as it is here.
TEST(SealOpenings, PinholesAreClosedWhereverTheyLie) {
  constexpr double kHole = 0.0017;
  const TriangleSoup shell = pierced_shell(kHole, 0.03, 32);
  const std::size_t cases = share_of_cases(std::size_t{4});
  for (std::size_t i = 0; i < cases; ++i) {
    const double aside = 0.02 * static_cast<double>(i);
    const auto turn = Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), Vec3d(-aside, aside, 1));
    const RepairResult full = sealed(transformed(shell, turn.toRotationMatrix()), 3 * kHole);
    EXPECT_EQ(full.report.seal.openings, 1u) << i;
    EXPECT_EQ(full.report.seal.leaks, 0u) << i;
  }
}

TEST(SealOpenings, TheSizeMayBeFound) {
  RepairOptions options;
  options.seal.automatic = true;
  const RepairResult full = repair(pierced_shell(0.05, 0.1, 48), options);
  EXPECT_EQ(full.report.seal.openings, 1u);
  EXPECT_GT(full.report.seal.size, 0.1);
  EXPECT_LT(full.report.seal.size, 0.3);
  EXPECT_GT(signed_volume(full.surface.mesh), 0.98 * kBall);
  const RepairResult mug = repair(revolved(kMug, 48), options);
  EXPECT_EQ(mug.report.seal.openings, 0u);
  EXPECT_EQ(mug.report.seal.size, 0);
}

// Each with the size that fits it, and the mug stays.
TEST(SealOpenings, SizesAreFoundForAllThatStandTogether) {
  TriangleSoup three = pierced_shell(0.02, 0.1, 48);
  append(three, moved(pierced_shell(0.1, 0.1, 48), {2.2, 0, 0}));
  append(three, moved(revolved(kMug, 48), {4.5, 0, 0}));
  RepairOptions options;
  options.seal.automatic = true;
  const RepairResult full = repair(three, options);
  EXPECT_EQ(full.report.seal.openings, 2u);
  EXPECT_TRUE(full.report.certify.passed());
  const double mug = std::abs(signed_volume(revolved(kMug, 48)));
  EXPECT_NEAR(signed_volume(full.surface.mesh) - mug, 2 * kBall, 0.02 * kBall);
}

TEST(SealOpenings, TooSmallSizesAreRefusedWithOneThatIsNot) {
  RepairOptions options;
  options.seal = {.size = 1e-5, .most_cubes = 1 << 18};
  const TriangleSoup shell = pierced_shell(0.01, 0.1, 48);
  std::string message;
  try {
    (void)repair(shell, options);
  } catch (const UsageError& error) {
    message = error.what();
  }
  const std::string before = "give a size to seal from ";
  const std::size_t at = message.find(before);
  ASSERT_NE(at, std::string::npos) << message;
  options.seal.size = std::stod(message.substr(at + before.size()));
  EXPECT_NO_THROW((void)repair(shell, options));
}

TEST(SealOpenings, TooManyCubesAreRefused) {
  RepairOptions options;
  options.seal = {.size = 0.03, .most_cubes = 1 << 10};
  EXPECT_THROW((void)repair(pierced_shell(0.01, 0.1, 48), options), UsageError);
}

// Between many bodies there are crevices of all widths, patches that lie above each other, and
// patches that touch each other along edges.
TEST(SealOpenings, CrevicesOfAnyKindAreSealed) {
  std::size_t openings = 0;
  const std::size_t cases = share_of_cases(std::size_t{8});
  for (std::size_t i = 0; i < cases; ++i) {
    const TriangleSoup soup = i % 2 == 0 ? random_cubes(40, i) : random_grid_boxes(30, 12, i);
    const RepairResult open = sealed(soup, 0);
    for (const double share : {0.06, 0.15}) {
      RepairOptions options;
      options.seal = {.size = share, .is_share = true, .most_cubes = std::size_t{1} << 20};
      const RepairResult result = repair(open.surface.mesh, options);
      const SealReport& seal = result.report.seal;
      EXPECT_TRUE(result.report.certify.passed() || result.report.kept_valid) << i;
      EXPECT_TRUE(result.report.output.closed() && result.report.output.manifold()) << i;
      EXPECT_NEAR(result.report.output_volume, open.report.output_volume + seal.filled_volume,
                  1e-4 * open.report.output_volume)
          << i << " " << share;
      openings += seal.openings;
    }
  }
  if (cases >= 8) {
    EXPECT_GT(openings, 8u);
  }
}

}  // namespace
}  // namespace meshrepair
