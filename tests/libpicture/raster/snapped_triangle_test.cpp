// SPDX-License-Identifier: MIT
#include "raster/snapped_triangle.h"

#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

constexpr Range kAll{0, 64};

SnappedPoint corner(std::int32_t x, std::int32_t y) { return {x, y, true, 0.5}; }

// How often each sample is covered, clockwise triangles less the others.
class Counts {
 public:
  void add(const SnappedTriangle& triangle) {
    if (triangle.empty()) return;
    const Range rows = triangle.rows(kAll);
    for (std::int64_t row = rows.first; row < rows.end; ++row) {
      const Range covered = triangle.covered(row, kAll);
      for (std::int64_t column = covered.first; column < covered.end; ++column) {
        const auto place = static_cast<std::size_t>(row * kAll.end + column);
        sum_[place] += triangle.clockwise() ? 1 : -1;
        ++count_[place];
      }
    }
  }

  [[nodiscard]] const std::vector<int>& sum() const { return sum_; }
  [[nodiscard]] const std::vector<int>& count() const { return count_; }

 private:
  std::vector<int> sum_ = std::vector<int>(64 * 64);
  std::vector<int> count_ = std::vector<int>(64 * 64);
};

// Corners often in the middles of samples and on lines through them.
SnappedPoint random_corner(std::mt19937_64& random) {
  const auto coordinate = [&] {
    const auto value = static_cast<std::int32_t>(random() % (64 * 256));
    return random() % 2 == 0 ? value : value / 256 * 256 + 128;
  };
  const std::int32_t x = coordinate();
  return corner(x, coordinate());
}

TEST(SnappedTriangle, CoversWhatItsWeightsSay) {
  std::mt19937_64 random(3);
  for (int i = 0; i < share_of_cases(500); ++i) {
    const SnappedTriangle t(random_corner(random), random_corner(random), random_corner(random));
    if (t.empty()) continue;
    for (std::int64_t row = 0; row < 64; ++row) {
      const Range covered = t.covered(row, kAll);
      for (std::int64_t column = 0; column < 64; ++column) {
        const Weights w = t.weights(column, row);
        EXPECT_EQ(w[0] + w[1] + w[2], t.twice_area());
        const bool is_covered = column >= covered.first && column < covered.end;
        const bool is_inside = w[0] > 0 && w[1] > 0 && w[2] > 0;
        const bool is_outside = w[0] < 0 || w[1] < 0 || w[2] < 0;
        ASSERT_TRUE(is_inside ? is_covered : !is_outside || !is_covered);
        const Range rows = t.rows(kAll);
        ASSERT_TRUE(!is_covered || (row >= rows.first && row < rows.end));
      }
    }
  }
}

TEST(SnappedTriangle, TrianglesAroundAPointShareNoSampleAndLeaveNoneOut) {
  std::mt19937_64 random(4);
  for (int i = 0; i < share_of_cases(500); ++i) {
    const SnappedPoint middle = random_corner(random);
    const std::vector<SnappedPoint> rim = {corner(0, 0), random_corner(random), corner(64 * 256, 0),
                                           corner(64 * 256, 64 * 256), corner(0, 64 * 256)};
    Counts counts;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      counts.add({middle, rim[k], rim[(k + 1) % rim.size()]});
    }
    // The second corner may be anywhere, so that triangles may be turned over; whoever is inside
    // the outline is there once, all in all.
    Counts outline;
    outline.add({rim[0], rim[1], rim[2]});
    outline.add({rim[0], rim[2], rim[3]});
    outline.add({rim[0], rim[3], rim[4]});
    ASSERT_EQ(counts.sum(), outline.sum());
  }
}

TEST(SnappedTriangle, TwoHalvesOfASquareCoverEachSampleOnce) {
  for (std::int32_t shift = 0; shift < 256; shift += 32) {
    const SnappedPoint a = corner(shift, shift), b = corner(4096 + shift, shift),
                       c = corner(4096 + shift, 4096 + shift), d = corner(shift, 4096 + shift);
    Counts counts;
    counts.add({a, b, c});
    counts.add({c, d, a});
    int covered = 0;
    for (const int count : counts.count()) {
      ASSERT_LE(count, 1);
      covered += count;
    }
    EXPECT_EQ(covered, 16 * 16);
  }
}

// Rays through a closed mesh enter it as often as they leave it: no sample falls between triangles.
TEST(SnappedTriangle, ClosedMeshesLeaveNoPinHoles) {
  for (const TriangleSoup& soup : {testing::sphere(2000), testing::torus(40, 24), testing::cube(),
                                   testing::noisy_sphere(1500, 0.2, 5)}) {
    for (const char* view : {"front", "iso", "33,21", "top"}) {
      const Camera camera(*view_of(view), {64, 64}, {&soup});
      Counts counts;
      for (const auto& [a, b, c] : soup.triangles) {
        counts.add({snapped(camera.place(soup.points[a]), 1),
                    snapped(camera.place(soup.points[b]), 1),
                    snapped(camera.place(soup.points[c]), 1)});
      }
      EXPECT_EQ(counts.sum(), std::vector<int>(64 * 64, 0)) << view;
    }
  }
}

// Seen from outside a convex solid is there once in front of all that it hides.
TEST(SnappedTriangle, FrontFacesOfAConvexSolidCoverItsOutlineOnce) {
  const TriangleSoup soup = testing::box({0, 0, 0}, {3, 2, 1});
  const Camera camera(*view_of("30,20"), {64, 64}, {&soup});
  Counts front, all;
  for (const auto& [a, b, c] : soup.triangles) {
    const SnappedTriangle triangle(snapped(camera.place(soup.points[a]), 1),
                                   snapped(camera.place(soup.points[b]), 1),
                                   snapped(camera.place(soup.points[c]), 1));
    all.add(triangle);
    if (!triangle.clockwise()) front.add(triangle);  // the picture's y goes down
  }
  int covered = 0;
  for (std::size_t i = 0; i < front.count().size(); ++i) {
    ASSERT_EQ(front.count()[i], all.count()[i] / 2);
    ASSERT_LE(front.count()[i], 1);
    covered += front.count()[i];
  }
  EXPECT_GT(covered, 1000);
}

TEST(Snapped, PlacesOutOfReachAreNotShown) {
  EXPECT_FALSE(snapped({std::numeric_limits<double>::quiet_NaN(), 0, 0}, 3).shown);
  EXPECT_FALSE(snapped({0, std::numeric_limits<double>::infinity(), 0}, 3).shown);
  EXPECT_FALSE(snapped({1e6, 0, 0}, 3).shown);
  EXPECT_TRUE(snapped({1e5, -1e5, 0}, 3).shown);
  EXPECT_EQ(snapped({1.5, 0, 0}, 2).x, 768);
}

TEST(SnappedTriangle, TheLargestTrianglesDoNotOverflow) {
  const std::int32_t far = 1 << 28;
  const SnappedTriangle t(corner(-far, -far), corner(far, -far), corner(far, far));
  EXPECT_EQ(t.twice_area(), std::int64_t{4} * far * far);
  EXPECT_EQ(t.covered(5, kAll).end, 64);
  EXPECT_EQ(t.covered(5, kAll).first, 5);
}

}  // namespace
}  // namespace meshrepair
