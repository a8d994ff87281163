// SPDX-License-Identifier: MIT
// Proofs that all points of a tetrahedron are deep below a surface, or none is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "common/depth.h"

namespace meshrepair::internal {

// The convex hull of its corners, some of which may be the same.
using Piece = std::array<Place, 4>;

// The largest distance of a corner from this one.
[[nodiscard]] double reach_of(const Piece& piece, std::size_t corner);

enum class Proof {
  holds,
  fails,  // some point tells so
  open,   // neither was found within the work allowed
};

// Over several pieces. Distances are those to the surface.
class DepthProver {
 public:
  // At most so many pieces are looked at.
  DepthProver(const Depth& depth, std::size_t most_pieces) : depth_(depth), left_(most_pieces) {}

  // No point is nearer to the surface than `distance`.
  [[nodiscard]] Proof is_beyond(const Piece& piece, double distance);
  // No point that is inside the solid is farther from the surface than `distance`.
  [[nodiscard]] Proof is_within(const Piece& piece, double distance);

  // What was proven for all pieces together: not above and not below the distance of any point.
  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double most() const { return most_; }

 private:
  template <class Judge>
  Proof prove(const Piece& piece, const Judge& judge);
  [[nodiscard]] Proof judge_beyond(const Piece& piece, double distance);
  [[nodiscard]] Proof judge_within(const Piece& piece, double distance);
  [[nodiscard]] double farthest_from(std::uint32_t triangle, const Piece& piece,
                                     double enough) const;
  [[nodiscard]] bool is_apart(const Piece& piece, double distance, double& least);

  const Depth& depth_;
  std::size_t left_;
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = 0;
  bool is_crowded_ = false;  // too many triangles are near, and will be for smaller pieces
};

}  // namespace meshrepair::internal
