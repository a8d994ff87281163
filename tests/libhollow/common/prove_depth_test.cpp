// SPDX-License-Identifier: MIT
#include "common/prove_depth.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "shapes.h"

namespace meshrepair::internal {
namespace {

using testing::Random;

Piece random_piece(const Depth& depth, double size, Random& random) {
  const Vec3d at(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
  Piece piece;
  for (Place& corner : piece) {
    const Vec3d by(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
    corner = depth.place(at + size * by, 0);
  }
  return piece;
}

Vec3d random_point(const Piece& piece, Random& random) {
  Vec3d sum = Vec3d::Zero();
  double weights = 0;
  for (const Place& corner : piece) {
    const double weight = random.real(0, 1);
    sum += weight * corner.at;
    weights += weight;
  }
  return sum / weights;
}

TEST(ProveDepth, NoPointIsBeyondWhatIsProven) {
  for (const TriangleSoup& solid : {testing::sphere(800), testing::box({-1, -1, -1}, {1, 1, 1}),
                                    testing::torus(20, 12, 1, 0.4)}) {
    const Depth depth(solid);
    Random random(3);
    int proven = 0;
    for (int i = 0; i < 100; ++i) {
      const Piece piece = random_piece(depth, random.real(0.01, 0.5), random);
      const double asked = random.real(0.02, 0.4);
      DepthProver lower(depth, 500), upper(depth, 500);
      const Proof beyond = lower.is_beyond(piece, asked);
      const Proof within = upper.is_within(piece, asked);
      proven += beyond == Proof::holds ? 1 : 0;
      proven += within == Proof::holds ? 1 : 0;
      for (int k = 0; k < 30; ++k) {
        const Vec3d point = random_point(piece, random);
        const double distance = depth.place(point, 0).distance;
        if (beyond == Proof::holds) {
          EXPECT_GE(lower.least(), asked);
          EXPECT_GE(distance, lower.least() * (1 - 1e-12));
        }
        if (within == Proof::holds && distance > upper.most() * (1 + 1e-12)) {
          EXPECT_FALSE(depth.is_inside(point));
        }
      }
    }
    EXPECT_GT(proven, 20);
  }
}

TEST(ProveDepth, APointThatIsTooNearRefutes) {
  const TriangleSoup solid = testing::box({0, 0, 0}, {4, 4, 4});
  const Depth depth(solid);
  Piece piece;
  for (std::size_t i = 0; i < 4; ++i)
    piece[i] = depth.place(Vec3d(2, 2, 0.5 + 0.3 * static_cast<double>(i)), 0);
  DepthProver prover(depth, 1000);
  EXPECT_EQ(prover.is_beyond(piece, 0.4), Proof::holds);
  EXPECT_EQ(prover.is_beyond(piece, 0.6), Proof::fails);
  EXPECT_EQ(prover.is_within(piece, 1.5), Proof::holds);
  EXPECT_EQ(prover.is_within(piece, 1.3), Proof::fails);
}

// Large flat walls are proven in a few steps.
TEST(ProveDepth, FlatWallsAreProvenAsAWhole) {
  const TriangleSoup solid = testing::box({0, 0, 0}, {100, 100, 100});
  const Depth depth(solid);
  Piece piece = {depth.place(Vec3d(5, 5, 1), 0), depth.place(Vec3d(95, 5, 1), 0),
                 depth.place(Vec3d(95, 90, 1), 0), Place()};
  piece[3] = piece[2];
  DepthProver prover(depth, 200);
  EXPECT_EQ(prover.is_beyond(piece, 0.98), Proof::holds);
}

}  // namespace
}  // namespace meshrepair::internal
