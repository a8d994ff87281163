// SPDX-License-Identifier: MIT
#include "triangle_piece.h"

#include <cmath>

#include <Eigen/Geometry>

namespace meshrepair::internal {

double TrianglePiece::share() const { return std::ldexp(1.0, -depth); }

double TrianglePiece::longest_side(std::size_t& begin) const {
  double longest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = (corners[(k + 1) % 3] - corners[k]).squaredNorm();
    if (!(side > longest)) continue;
    longest = side;
    begin = k;
  }
  return longest;
}

bool TrianglePiece::is_to_halve(double square) const {
  std::size_t begin = 0;
  return depth < kMostDepth && longest_side(begin) > square;
}

std::array<TrianglePiece, 2> TrianglePiece::halves() const {
  std::size_t begin = 0;
  (void)longest_side(begin);
  const Vec3d &a = corners[begin], &b = corners[(begin + 1) % 3], &c = corners[(begin + 2) % 3];
  const Vec3d middle = 0.5 * a + 0.5 * b;
  return {{{{a, middle, c}, depth + 1, path},
           {{middle, b, c}, depth + 1, path | std::uint64_t{1} << (63 - depth)}}};
}

std::uint64_t path_to(const Vec3d& point, const std::array<Vec3d, 3>& triangle, double square) {
  TrianglePiece piece{triangle};
  const Vec3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  while (piece.is_to_halve(square)) {
    const std::array<TrianglePiece, 2> halves = piece.halves();
    const Vec3d &middle = halves[1].corners[0], &c = halves[1].corners[2];
    const bool is_second = (c - middle).cross(point - middle).dot(normal) < 0;
    piece = halves[is_second ? 1 : 0];
  }
  return piece.path;
}

}  // namespace meshrepair::internal
