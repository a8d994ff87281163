// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include <repair/repair.h>

#include "random_solids.h"
#include "revolved.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

RepairReport report_by(const TriangleSoup& soup, InsideRule rule) {
  RepairOptions options;
  options.inside.rule = rule;
  options.certify.wanted = false;  // the solid matters, not how it is written
  return repair(soup, options).report;
}

double volume_read_by(const TriangleSoup& soup, InsideRule rule) {
  return report_by(soup, rule).output_volume;
}

TriangleSoup both_of(TriangleSoup first, const TriangleSoup& second) {
  append(first, second);
  return first;
}

// A smooth body around the origin, which has many triangulations.
class RandomBody {
 public:
  explicit RandomBody(Random& random) : axes_(random.real(0.6, 1.4), random.real(0.6, 1.4), 1) {
    for (Vec3d& wave : waves_) {
      wave = {random.real(-3, 3), random.real(-3, 3), random.real(-3, 3)};
    }
  }

  // Its points are moved along their rays, by up to the share `rough` of their distance.
  [[nodiscard]] TriangleSoup surface(std::size_t triangles, double size, double rough,
                                     Random& random) const {
    TriangleSoup soup = transformed(sphere(triangles), random_rotation(random));
    for (Vec3d& p : soup.points) {
      double radius = 1;
      for (const Vec3d& wave : waves_) radius += 0.1 * std::sin(wave.dot(p));
      p = size * radius * (1 + random.real(-rough, rough)) * axes_.cwiseProduct(p);
    }
    return soup;
  }

 private:
  Vec3d axes_;
  std::array<Vec3d, 3> waves_;
};

TEST(TurnParts, ARoughThinWallKeepsItsCavity) {
  const std::size_t cases = share_of_cases(std::size_t{500});
  std::size_t lost = 0, poking = 0, poking_much = 0;
  for (std::size_t seed = 0; seed < cases; ++seed) {
    Random random(seed);
    const RandomBody body(random);
    const double wall = random.real(0.005, 0.05);
    const double rough = wall * random.real(0.6, 2.2);
    const TriangleSoup outer = body.surface(400, 1, rough, random);
    const TriangleSoup inner = body.surface(400, 1 - wall, rough, random);
    const RepairReport report = report_by(both_of(outer, flipped(inner)), InsideRule::automatic);
    lost += report.inside.turned_parts != 0 || report.output_volume > 0.5 * signed_volume(outer);
    poking += report.inside.poking_walls;
    poking_much += report.inside.poking_share > 0.1;
  }
  EXPECT_LE(lost, cases / 100);
  EXPECT_GE(poking, expected_cases(std::size_t{400}));
  EXPECT_GE(poking_much, expected_cases(std::size_t{100}));
}

// Two of any solids, which overlap, and neither of which is nearly swallowed by the other.
TEST(TurnParts, OneOfTwoOverlappingBodiesThatIsInsideOutIsTurned) {
  const std::size_t cases = share_of_cases(std::size_t{500});
  std::size_t wrong = 0, tried = 0;
  for (std::uint64_t seed = 0; tried < cases; ++seed) {
    Random random(seed);
    const TriangleSoup one = random_solid(random), other = random_solid(random);
    const double united = volume_read_by(both_of(one, other), InsideRule::winding);
    const double common = signed_volume(one) + signed_volume(other) - united;
    if (common < 1e-6 || common > 0.8 * std::min(signed_volume(one), signed_volume(other))) {
      continue;
    }
    ++tried;
    const RepairReport report = report_by(both_of(one, flipped(other)), InsideRule::automatic);
    wrong += report.inside.turned_parts != 1 || std::abs(report.output_volume - united) > 1e-5;
  }
  EXPECT_LE(wrong, cases / 100);
}

// Half of each lies outside the other, whatever they are apart.
TEST(TurnParts, OfABodyThatIsThereTwiceTheOneThatIsInsideOutIsTurned) {
  const std::size_t cases = share_of_cases(std::size_t{100});
  std::size_t wrong = 0;
  for (std::size_t seed = 0; seed < cases; ++seed) {
    Random random(seed);
    const RandomBody body(random);
    const double rough = random.real(0.001, 0.1);
    const TriangleSoup one = body.surface(400, 1, rough, random);
    const Vec3d by = random.real(0, 0.2) * Vec3d(random_rotation(random).col(0));
    const TriangleSoup other = moved(body.surface(400, 1, rough, random), by);
    const double united = volume_read_by(both_of(one, other), InsideRule::winding);
    const RepairReport report = report_by(both_of(one, flipped(other)), InsideRule::automatic);
    wrong += report.inside.turned_parts != 1 || std::abs(report.output_volume - united) > 1e-5;
  }
  EXPECT_LE(wrong, cases / 100);
}

// A ball of radius 0.5 that faces inward, so far from the centre of a large one.
TriangleSoup ball_with_a_dent(double away) {
  return both_of(sphere(3000), flipped(sphere(1000, 0.5, {away, 0.011, 0.023})));
}

TEST(TurnParts, TheOtherReadingIsNamedWhereItIsNearlyAsLikely) {
  struct Case {
    double away;
    bool cavity;
    InsideRule other;
  };
  for (const Case& c :
       {Case{0.4, true, InsideRule::automatic}, Case{0.6, true, InsideRule::automatic},
        Case{0.7, true, InsideRule::solidity}, Case{0.8, false, InsideRule::winding},
        Case{1, false, InsideRule::automatic}}) {
    SCOPED_TRACE(c.away);
    const TriangleSoup soup = ball_with_a_dent(c.away);
    const RepairReport report = report_by(soup, InsideRule::automatic);
    EXPECT_EQ(report.inside.turned_parts, c.cavity ? 0u : 1u);
    EXPECT_EQ(report.inside.other, c.other) << rule_name(report.inside.other);
    EXPECT_EQ(report.inside.poking_walls, c.cavity && c.away > 0.5 ? 1u : 0u);
    if (c.other == InsideRule::automatic) continue;
    // It is another solid indeed.
    const double sign = c.cavity ? 1 : -1;
    EXPECT_GT(sign * (volume_read_by(soup, c.other) - report.output_volume), 0.2);
  }
}

TEST(TurnParts, TheShareThatPokesOutIsThatOfTheArea) {
  // Of a sphere, a cap has the share of the diameter that it is high.
  const double away = 0.65, small = 0.5;
  const double plane = (1 - small * small + away * away) / (2 * away);  // of the common circle
  const double cap = (away + small - plane) / (2 * small);
  const RepairReport report = report_by(ball_with_a_dent(away), InsideRule::automatic);
  EXPECT_NEAR(report.inside.poking_share, cap, 0.02);
}

// Parts whose triangles say nothing are cavities only where nearly all of them is inside.
TEST(TurnParts, WhatSaysNothingAndPokesOutIsABody) {
  const TriangleSoup ball = sphere(3000), small = sphere(1000, 0.5, {0.65, 0.011, 0.023});
  const RepairReport report =
      report_by(both_of(ball, with_some_flipped(small, 0.5, 1)), InsideRule::automatic);
  EXPECT_EQ(report.inside.cavity_walls, 0u);
  EXPECT_EQ(report.inside.poking_walls, 0u);
  EXPECT_GT(report.output_volume, signed_volume(ball));
}

// A ring of which each triangle is there both ways round, and a hub within it likewise.
TEST(TurnParts, AHubIsNoVoidInARingWithLids) {
  TriangleSoup soup = revolved({{1, 0.5}, {1, 0}}, 20);
  append(soup, revolved({{0, 0.4}, {0.3, 0.4}, {0.3, 0.1}, {0, 0.1}}, 12));
  TriangleSoup back = soup;
  for (IndexTriangle& t : back.triangles) std::swap(t[1], t[2]);
  append(soup, back);
  const RepairReport report = report_by(soup, InsideRule::automatic);
  EXPECT_EQ(report.inside.cavity_walls, 0u);
  EXPECT_NEAR(report.output_volume, 0.5 * 10 * std::sin(0.1 * std::numbers::pi), 1e-6);
}

}  // namespace
}  // namespace meshrepair
