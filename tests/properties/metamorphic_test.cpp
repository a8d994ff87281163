// SPDX-License-Identifier: MIT
// What a change of the input must do to the output.
#include <algorithm>
#include <bit>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <repair/repair.h>

#include "complexes.h"
#include "degenerate_soups.h"
#include "share_of_cases.h"
#include "triangles_by_place.h"

namespace meshrepair {
namespace {

using namespace testing;

std::vector<SoupFamily> families() {
  std::vector<SoupFamily> all = degenerate_families();
  all.push_back({"NoisySphere", [](std::uint64_t s) { return noisy_sphere(120, 0.15, s); }});
  all.push_back({"Cubes", [](std::uint64_t s) { return random_cubes(6, s); }});
  all.push_back({"HolesAndOverlap", [](std::uint64_t s) {
                   return without_some(two_overlapping_spheres(160), 0.05, s);
                 }});
  return all;
}

// Every other seed is repaired with all cells.
bool by_cells = false;

// Nothing when nothing is enclosed.
std::optional<RepairResult> try_repair(const TriangleSoup& soup,
                                       InsideRule rule = InsideRule::solidity,
                                       bool certified = true) {
  RepairOptions options;
  options.all_cells = by_cells;
  options.certify.wanted = certified;
  options.inside.rule = rule;
  try {
    return repair(soup, options);
  } catch (const NoSolidError&) {
    return std::nullopt;
  }
}

void expect_same_bits(const TriangleSoup& a, const TriangleSoup& b) {
  ASSERT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(a.points[i][axis]),
                std::bit_cast<std::uint64_t>(b.points[i][axis]))
          << "point " << i;
    }
  }
}

void expect_same_mesh(const std::optional<RepairResult>& a, const std::optional<RepairResult>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  expect_same_bits(a->surface.mesh, b->surface.mesh);
  EXPECT_EQ(a->surface.source, b->surface.source);
}

void expect_same_volume(const std::optional<RepairResult>& a,
                        const std::optional<RepairResult>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  const double size = std::pow(a->report.output_area, 1.5);
  EXPECT_NEAR(a->report.output_volume, b->report.output_volume, 1e-9 * size);
}

// The solve is iterative: where a value is as good as 0 either sign is right.
bool is_clear(const std::optional<RepairResult>& result) {
  return !result || result->report.inside.exact;
}

class Metamorphic : public ::testing::TestWithParam<SoupFamily> {
 protected:
  template <class Check>
  void for_seeds(std::uint64_t count, Check check) {
    for (std::uint64_t seed = 400; seed < 400 + share_of_cases(count); ++seed) {
      SCOPED_TRACE(seed);
      by_cells = seed / 2 % 2 != 0;
      check(GetParam().make(seed), seed);
    }
  }
};

TEST_P(Metamorphic, TheSameInputGivesTheSameBytes) {
  for_seeds(4, [](const TriangleSoup& soup, std::uint64_t) {
    for (const InsideRule rule : {InsideRule::automatic, InsideRule::solidity}) {
      expect_same_mesh(try_repair(soup, rule), try_repair(soup, rule));
    }
  });
}

TEST_P(Metamorphic, ScalingByTwoScalesTheBytes) {
  for_seeds(6, [](const TriangleSoup& soup, std::uint64_t seed) {
    const double factor = seed % 2 == 0 ? 2 : 0x1p-30;
    auto result = try_repair(soup);
    const auto other = try_repair(scaled(soup, factor));
    if (result) result->surface.mesh = scaled(result->surface.mesh, factor);
    expect_same_mesh(result, other);
  });
}

// The tree and the cells are the same; new points are rounded at another place, so what
// certification has to mend may differ.
TEST_P(Metamorphic, MovingByMultiplesOfTheUnitMovesTheMesh) {
  for_seeds(6, [](const TriangleSoup& given, std::uint64_t seed) {
    // Rounded so that the moved coordinates are exact.
    TriangleSoup soup = given;
    for (Vec3d& p : soup.points) p = (p * 0x1p20).array().round() * 0x1p-20;
    CleanReport report;
    const double unit = std::max(clean_soup(soup, report).grid.unit, 0x1p-20);
    Random random(seed);
    const Vec3d by = unit * Vec3d(random.integer(-999, 999), random.integer(-999, 999),
                                  random.integer(-999, 999));
    const auto a = try_repair(soup, InsideRule::solidity, false);
    const auto b = try_repair(moved(soup, by), InsideRule::solidity, false);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) return;
    ASSERT_EQ(a->surface.source, b->surface.source);
    ASSERT_EQ(a->surface.mesh.points.size(), b->surface.mesh.points.size());
    for (std::size_t i = 0; i < a->surface.mesh.points.size(); ++i) {
      const Vec3d expected = a->surface.mesh.points[i] + by;
      const double rounding = 0x1p-50 * (expected.norm() + by.norm()) + 0x1p-24 * unit;
      EXPECT_LE((b->surface.mesh.points[i] - expected).norm(), rounding);
    }
  });
}

TEST_P(Metamorphic, PermutedTrianglesEncloseTheSameVolume) {
  for_seeds(6, [](const TriangleSoup& soup, std::uint64_t seed) {
    TriangleSoup shuffled = soup;
    Random random(seed);
    for (std::size_t i = shuffled.triangles.size(); i-- > 1;) {
      const auto j = static_cast<std::size_t>(random.integer(0, static_cast<std::int32_t>(i)));
      std::swap(shuffled.triangles[i], shuffled.triangles[j]);
      auto& t = shuffled.triangles[i];
      std::rotate(t.begin(), t.begin() + random.integer(0, 2), t.end());
    }
    // Another tree has other cells, and where input is missing other gaps are closed.
    for (const InsideRule rule : {InsideRule::parity, InsideRule::automatic}) {
      const auto a = try_repair(soup, rule);
      const auto b = try_repair(shuffled, rule);
      if (a && b) {
        expect_closed_manifold(b->surface.mesh);
        EXPECT_EQ(a->report.inside.exact, b->report.inside.exact);
      }
      if (is_clear(a) && is_clear(b)) expect_same_volume(a, b);
    }
  });
}

TEST_P(Metamorphic, TurningAllTrianglesEnclosesTheSameVolume) {
  for_seeds(6, [](const TriangleSoup& soup, std::uint64_t) {
    const auto a = try_repair(soup, InsideRule::automatic);
    const auto b = try_repair(flipped(soup), InsideRule::automatic);
    if (is_clear(a) && is_clear(b)) expect_same_volume(a, b);
  });
}

TEST_P(Metamorphic, MirroredTrianglesEncloseTheSameVolume) {
  for_seeds(6, [](const TriangleSoup& soup, std::uint64_t) {
    TriangleSoup mirrored = flipped(soup);
    for (Vec3d& p : mirrored.points) p.x() = -p.x();
    const auto a = try_repair(soup, InsideRule::parity);
    const auto b = try_repair(mirrored, InsideRule::parity);
    if (a && b) expect_closed_manifold(b->surface.mesh);
    if (is_clear(a) && is_clear(b)) expect_same_volume(a, b);
  });
}

TEST_P(Metamorphic, FlippingAnySubsetGivesTheSameBytesBySolidity) {
  for_seeds(8, [](const TriangleSoup& soup, std::uint64_t seed) {
    const double share = seed % 4 == 0 ? 1.0 : 0.4;
    const TriangleSoup turned = with_some_flipped(soup, share, seed);
    for (const InsideRule rule : {InsideRule::solidity, InsideRule::parity}) {
      const auto a = try_repair(soup, rule), b = try_repair(turned, rule);
      if (by_cells) {
        expect_same_mesh(a, b);
      } else if (is_clear(a) && is_clear(b)) {  // which way applies depends on how triangles face
        expect_same_volume(a, b);
      }
    }
  });
}

// A triangle that comes out whole starts at the corner at which it came in.
TEST_P(Metamorphic, RotatingCornersGivesTheSameTriangles) {
  for_seeds(6, [](const TriangleSoup& soup, std::uint64_t seed) {
    TriangleSoup rotated = soup;
    Random random(seed);
    for (auto& t : rotated.triangles) {
      std::rotate(t.begin(), t.begin() + random.integer(0, 2), t.end());
    }
    for (const InsideRule rule : {InsideRule::automatic, InsideRule::solidity}) {
      const auto a = try_repair(soup, rule);
      const auto b = try_repair(rotated, rule);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      expect_same_volume(a, b);
      if (!by_cells) continue;  // flat pieces that are cut may be divided otherwise
      EXPECT_EQ(triangles_by_place(a->surface.mesh), triangles_by_place(b->surface.mesh));
    }
  });
}

std::vector<std::int32_t> layers_of(const TriangleSoup& soup) {
  CleanReport report;
  std::vector<std::int32_t> layers;
  for (const Triangle& t : clean_soup(soup, report).triangles) layers.push_back(t.layers);
  return layers;
}

// But where as many layers as there are copies now balance the edges around.
TEST_P(Metamorphic, DuplicateTrianglesAddNothing) {
  for_seeds(6, [](const TriangleSoup& soup, std::uint64_t seed) {
    TriangleSoup more = soup;
    Random random(seed);
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
      auto t = soup.triangles[i];
      if (random.chance(0.5)) continue;
      std::rotate(t.begin(), t.begin() + random.integer(0, 2), t.end());
      more.triangles.push_back(t);
    }
    if (layers_of(more) != layers_of(soup)) return;
    for (const InsideRule rule : {InsideRule::automatic, InsideRule::solidity}) {
      expect_same_mesh(try_repair(soup, rule), try_repair(more, rule));
    }
  });
}

// What comes out is a clean solid: it encloses the same when it is put in again.
TEST_P(Metamorphic, RepairingTheResultKeepsItsVolume) {
  for_seeds(3, [](const TriangleSoup& soup, std::uint64_t) {
    const auto once = try_repair(soup, InsideRule::parity);
    if (!once) return;
    const auto twice = try_repair(once->surface.mesh, InsideRule::parity);
    const double size = std::pow(once->report.output_area, 1.5);
    EXPECT_NEAR(twice ? twice->report.output_volume : 0, once->report.output_volume, 1e-6 * size);
  });
}

INSTANTIATE_TEST_SUITE_P(Families, Metamorphic, ::testing::ValuesIn(families()),
                         [](const auto& param_info) { return param_info.param.name; });

}  // namespace
}  // namespace meshrepair
