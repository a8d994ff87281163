// SPDX-License-Identifier: MIT
// Unions of boxes with integer corners, whose volume is known exactly.
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <repair/repair.h>

#include "complexes.h"
#include "degenerate_soups.h"
#include "each_seed.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

struct IntegerBox {
  std::array<std::int32_t, 3> low{}, high{};
};

std::vector<IntegerBox> random_boxes(std::size_t count, std::int32_t size, Random& random) {
  std::vector<IntegerBox> boxes(count);
  for (IntegerBox& b : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      b.low[axis] = random.integer(0, size - 1);
      b.high[axis] = random.integer(b.low[axis] + 1, size);
    }
  }
  return boxes;
}

TriangleSoup soup_of(const std::vector<IntegerBox>& boxes) {
  TriangleSoup soup;
  for (const IntegerBox& b : boxes) {
    append(soup, box(Vec3d(b.low[0], b.low[1], b.low[2]), Vec3d(b.high[0], b.high[1], b.high[2])));
  }
  return soup;
}

// How many boxes hold each unit cube of [0, size]^3.
std::vector<int> voxel_counts(const std::vector<IntegerBox>& boxes, std::int32_t size) {
  std::vector<int> counts;
  for (std::int32_t x = 0; x < size; ++x) {
    for (std::int32_t y = 0; y < size; ++y) {
      for (std::int32_t z = 0; z < size; ++z) {
        int count = 0;
        for (const IntegerBox& b : boxes) {
          count += b.low[0] <= x && x < b.high[0] && b.low[1] <= y && y < b.high[1] &&
                   b.low[2] <= z && z < b.high[2];
        }
        counts.push_back(count);
      }
    }
  }
  return counts;
}

double covered_volume(const std::vector<int>& counts) {
  double sum = 0;
  for (const int count : counts) sum += count > 0;
  return sum;
}

// Of `size` cubed voxels, those that infinity cannot reach without entering a box.
double filled_volume(const std::vector<int>& counts, std::int32_t size) {
  const auto at = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return static_cast<std::size_t>((x * size + y) * size + z);
  };
  std::vector<char> reached(counts.size(), 0);
  std::vector<std::array<std::int32_t, 3>> queue;
  const auto reach = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    if (x < 0 || y < 0 || z < 0 || x >= size || y >= size || z >= size) return;
    if (counts[at(x, y, z)] > 0 || reached[at(x, y, z)] != 0) return;
    reached[at(x, y, z)] = 1;
    queue.push_back({x, y, z});
  };
  for (std::int32_t a = 0; a < size; ++a) {
    for (std::int32_t b = 0; b < size; ++b) {
      for (const std::int32_t end : {0, size - 1}) {
        reach(end, a, b);
        reach(a, end, b);
        reach(a, b, end);
      }
    }
  }
  while (!queue.empty()) {
    const auto [x, y, z] = queue.back();
    queue.pop_back();
    reach(x - 1, y, z);
    reach(x + 1, y, z);
    reach(x, y - 1, z);
    reach(x, y + 1, z);
    reach(x, y, z - 1);
    reach(x, y, z + 1);
  }
  double sum = static_cast<double>(counts.size());
  for (const char r : reached) sum -= r;
  return sum;
}

double volume_by(const TriangleSoup& soup, InsideRule rule,
                 Touching touching = Touching::separate) {
  RepairOptions options;
  options.extract.touching = touching;
  options.inside.rule = rule;
  const RepairResult result = repair(soup, options);
  expect_closed_manifold(result.surface.mesh);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_EQ(result.report.clip.fallbacks(), 0u);
  EXPECT_EQ(result.report.tree.lost_fragments, 0u);
  return result.report.output_volume;
}

bool has_equal_triangles(const TriangleSoup& soup) {
  CleanReport report;
  (void)clean_soup(soup, report);
  return report.duplicates + report.opposite_duplicates > 0;
}

TEST(BoxUnions, WindingGivesTheExactVolume) {
  int tried = 0;
  for (std::uint64_t seed = 0; seed < share_of_cases(120u); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::int32_t size = random.integer(4, 24);
    const auto boxes = random_boxes(static_cast<std::size_t>(random.integer(1, 14)), size, random);
    const TriangleSoup soup = soup_of(boxes);
    // Two boxes with a common face lose one of its two windings when equal triangles become one.
    if (has_equal_triangles(soup)) continue;
    ++tried;
    const double truth = covered_volume(voxel_counts(boxes, size));
    EXPECT_NEAR(volume_by(soup, InsideRule::winding), truth, 1e-9 * truth);
    EXPECT_NEAR(volume_by(soup, InsideRule::automatic), truth, 1e-9 * truth);
    EXPECT_NEAR(volume_by(soup, InsideRule::winding, Touching::join), truth, 1e-9 * truth);
  }
  EXPECT_GT(tried, expected_cases(80));
}

// Faces of different boxes in one plane are where the parity of a boundary is not that of its
// boxes; with all planes different it is, and the flood fills every void.
TEST(BoxUnions, ParityAndSolidityGiveTheExactVolume) {
  for (std::uint64_t seed = 0; seed < share_of_cases(60u); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::int32_t count = random.integer(1, 9);
    const std::int32_t size = 2 * count;
    std::vector<IntegerBox> boxes(static_cast<std::size_t>(count));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<std::int32_t> places;
      for (std::int32_t i = 0; i < size; ++i) places.push_back(i);
      for (std::size_t i = places.size(); i-- > 1;) {
        std::swap(
            places[i],
            places[static_cast<std::size_t>(random.integer(0, static_cast<std::int32_t>(i)))]);
      }
      for (std::size_t b = 0; b < boxes.size(); ++b) {
        boxes[b].low[axis] = std::min(places[2 * b], places[2 * b + 1]);
        boxes[b].high[axis] = std::max(places[2 * b], places[2 * b + 1]);
      }
    }
    const TriangleSoup soup = with_some_flipped(soup_of(boxes), 0.5, seed);
    const std::vector<int> counts = voxel_counts(boxes, size);
    double odd = 0;
    for (const int c : counts) odd += c % 2;
    EXPECT_NEAR(volume_by(soup, InsideRule::parity), odd, 1e-9 * odd);
    const double filled = filled_volume(counts, size);
    EXPECT_NEAR(volume_by(soup, InsideRule::solidity), filled, 1e-9 * filled);
  }
}

// Unit cubes that share corners and edges, mostly.
TEST(BoxUnions, CubesThatTouchAreSeparatedOrJoined) {
  for (std::uint64_t seed = 0; seed < share_of_cases(30u); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriangleSoup soup;
    double truth = 0;
    for (int k = 0; k < 125; ++k) {
      const int x = k % 5, y = k / 5 % 5, z = k / 25;
      // No two cubes of a checkerboard have a face in common.
      if ((x + y + z) % 2 != 0 || !random.chance(0.7)) continue;
      append(soup, box(Vec3d(x, y, z), Vec3d(x + 1, y + 1, z + 1)));
      ++truth;
    }
    EXPECT_NEAR(volume_by(soup, InsideRule::winding), truth, 1e-9 * truth);
    EXPECT_NEAR(volume_by(soup, InsideRule::winding, Touching::join), truth, 1e-9 * truth);
  }
}

// Far from the origin and on no round unit: the numbers are as exact as the doubles of the input.
TEST(BoxUnions, PlaceAndSizeDoNotMatter) {
  for_each_seed(20, [&](std::uint64_t seed) {
    Random random(seed);
    const auto boxes = random_boxes(6, 16, random);
    if (has_equal_triangles(soup_of(boxes))) return;
    const double truth = covered_volume(voxel_counts(boxes, 16));
    const double scale = std::ldexp(1.0, random.integer(-40, 40));
    const Vec3d by(random.integer(-100000, 100000), 77, -12345);
    const double volume = volume_by(scaled(moved(soup_of(boxes), by), scale), InsideRule::winding);
    EXPECT_NEAR(volume / (scale * scale * scale), truth, 1e-9 * truth);
  });
}

}  // namespace
}  // namespace meshrepair
