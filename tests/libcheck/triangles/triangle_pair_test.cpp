// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <optional>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <check/internal/triangle_pair.h>
#include <exact/double_predicates.h>

#include "random_geometry.h"

namespace meshrepair::internal {
namespace {

using testing::Random;
using Places = std::array<Vec3d, 3>;
using Corners = std::array<std::uint32_t, 3>;

CornerTriangle make(const Places& at, const Corners& corner) {
  return {at, corner, projection_axis(at[0], at[1], at[2])};
}

const Places kFlat = {Vec3d(0, 0, 0), Vec3d(4, 0, 0), Vec3d(0, 4, 0)};

Meeting with_flat(const Places& other, const Corners& corner = {3, 4, 5}) {
  return meeting_of(make(kFlat, {0, 1, 2}), make(other, corner));
}

TEST(TrianglePair, PairsWithoutSharedCornersAreDecided) {
  EXPECT_EQ(with_flat({Vec3d(1, 1, -1), {1, 1, 1}, {2, 1, 1}}), Meeting::crossing);
  EXPECT_EQ(with_flat({Vec3d(1, 1, 0), {1, 1, 1}, {2, 1, 1}}), Meeting::touching);
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {0, 0, 1}, {1, 0, 1}}), Meeting::touching);
  EXPECT_EQ(with_flat({Vec3d(1, 1, 0), {2, 1, 0}, {2, 1, 1}}), Meeting::touching);
  EXPECT_EQ(with_flat({Vec3d(1, 1, 1), {1, 1, 2}, {2, 1, 1}}), Meeting::apart);
  EXPECT_EQ(with_flat({Vec3d(5, 5, -1), {5, 5, 1}, {6, 5, 1}}), Meeting::apart);
  EXPECT_EQ(with_flat({Vec3d(2, 2, -1), {2, 2, 1}, {6, 5, 1}}), Meeting::crossing);
  EXPECT_EQ(with_flat({Vec3d(-1, 1, 0), {5, 1, 0}, {0, 1, 9}}), Meeting::touching);
}

// Nearly in one plane that leans against all axes, where these may differ.
TEST(TrianglePair, WhetherTheyNearlyOverlapDependsOnNoOrder) {
  Random random(1);
  std::size_t overlapping = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto place = [&] {
      const double u = random.real(0, 1), v = random.real(0, 1);
      return Vec3d(u, v, 1e-3 * random.real(-1, 1) - u - v);
    };
    const CornerTriangle a = make({place(), place(), place()}, {0, 1, 2});
    const CornerTriangle b = make({place(), place(), place()}, {3, 4, 5});
    const bool overlap = nearly_overlap(a, b, 2e-3);
    overlapping += overlap ? 1 : 0;
    ASSERT_EQ(overlap, nearly_overlap(b, a, 2e-3)) << i;
  }
  EXPECT_GT(overlapping, 1000u);
  EXPECT_LT(overlapping, 19000u);
}

TEST(TrianglePair, PairsInOnePlaneAreDecided) {
  EXPECT_EQ(with_flat({Vec3d(1, 1, 0), {2, 1, 0}, {1, 2, 0}}), Meeting::coplanar);
  EXPECT_EQ(with_flat({Vec3d(-9, -9, 0), {99, -9, 0}, {-9, 99, 0}}), Meeting::coplanar);
  EXPECT_EQ(with_flat({Vec3d(2, 2, 0), {5, 2, 0}, {5, 5, 0}}), Meeting::coplanar);
  EXPECT_EQ(with_flat({Vec3d(3, 3, 0), {5, 2, 0}, {5, 5, 0}}), Meeting::apart);
  EXPECT_EQ(with_flat({Vec3d(-1, 2, 0), {5, 2, 0}, {5, 3, 0}}), Meeting::coplanar);
}

TEST(TrianglePair, PairsWithASharedCornerAreDecided) {
  const Corners shared = {0, 4, 5};
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {1, 1, 1}, {2, 1, 1}}, shared), Meeting::apart);
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {1, 1, -1}, {1, 1, 1}}, shared), Meeting::crossing);
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {-1, -1, -1}, {-1, -1, 1}}, shared), Meeting::apart);
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {1, 0, 0}, {1, 0, 1}}, shared), Meeting::touching);
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {9, 9, 0}, {1, 0, 1}}, shared), Meeting::touching);
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {1, 1, 0}, {-1, 1, 0}}, shared), Meeting::coplanar);
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {-1, 0, 0}, {0, -1, 0}}, shared), Meeting::apart);
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {0, 9, 0}, {-9, 9, 0}}, shared), Meeting::coplanar);
}

TEST(TrianglePair, PairsWithASharedEdgeAreDecided) {
  EXPECT_EQ(with_flat({Vec3d(0, 0, 0), {4, 0, 0}, {0, 4, 1}}, {0, 1, 5}), Meeting::apart);
  EXPECT_EQ(with_flat({Vec3d(4, 0, 0), {0, 0, 0}, {0, -4, 0}}, {1, 0, 5}), Meeting::apart);
  EXPECT_EQ(with_flat({Vec3d(4, 0, 0), {0, 0, 0}, {9, 4, 0}}, {1, 0, 5}), Meeting::coplanar);
  EXPECT_EQ(with_flat({kFlat[1], kFlat[0], kFlat[2]}, {1, 0, 2}), Meeting::coplanar);
}

// Independent of the predicates: points of a lattice in one triangle, in small integers, which
// doubles hold exactly, are looked for in the other.
struct Lattice {
  static constexpr int kSteps = 12;

  // Is p in the triangle? All in integers.
  static bool inside(const Vec3d& p, const Places& t) {
    const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (normal.dot(p - t[0]) != 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (normal.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) < 0) return false;
    }
    return true;
  }
};

// A lattice point of one triangle inside the other proves that they meet.
bool found_by_lattice(const Places& a, const Places& b) {
  const auto scaled = [](Places t) {
    for (Vec3d& p : t) p *= Lattice::kSteps;
    return t;
  };
  const Places large = scaled(b);
  for (int i = 0; i <= Lattice::kSteps; ++i) {
    for (int j = 0; i + j <= Lattice::kSteps; ++j) {
      const Vec3d p = i * a[0] + j * a[1] + (Lattice::kSteps - i - j) * a[2];
      if (Lattice::inside(p, large)) return true;
    }
  }
  return false;
}

std::optional<CornerTriangle> random_triangle(Random& random, std::uint32_t first) {
  Places at;
  for (Vec3d& p : at) p = Vec3d(random.integer(0, 3), random.integer(0, 3), random.integer(0, 2));
  const CornerTriangle triangle = make(at, {first, first + 1, first + 2});
  if (triangle.axis < 0) return std::nullopt;
  return triangle;
}

TEST(TrianglePair, IsSymmetricAndMissesNoLatticePoint) {
  Random random(1);
  int meet = 0, proven = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto a = random_triangle(random, 0), b = random_triangle(random, 3);
    if (!a || !b) continue;
    const Meeting meeting = meeting_of(*a, *b);
    EXPECT_EQ(meeting_of(*b, *a), meeting);
    const CornerTriangle turned = make({b->at[2], b->at[0], b->at[1]}, {5, 3, 4});
    EXPECT_EQ(meeting_of(*a, turned), meeting);
    const CornerTriangle flipped = make({b->at[1], b->at[0], b->at[2]}, {4, 3, 5});
    EXPECT_EQ(meeting_of(flipped, *a), meeting);
    meet += meeting != Meeting::apart;
    if (found_by_lattice(a->at, b->at) || found_by_lattice(b->at, a->at)) {
      ++proven;
      EXPECT_NE(meeting, Meeting::apart);
    }
  }
  // Most of those that meet do so in a point of the lattice, so few can be claimed wrongly.
  EXPECT_GT(proven, 9 * meet / 10);
}

}  // namespace
}  // namespace meshrepair::internal
