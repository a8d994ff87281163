// SPDX-License-Identifier: MIT
// Walls at a depth below a surface, with few triangles, and what is proven of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/progress.h>
#include <mesh/precision.h>
#include <mesh/soup.h>

#include "common/depth.h"
#include "common/prove_depth.h"
#include "walls/find_cavities.h"

namespace meshrepair::internal {

class WallMaker {
 public:
  struct Bounds {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    std::size_t beside = 0;  // triangles for which kHollowError is not proven
  };

  // The solid has to stay; `precision` is that of the numbers that walls will have, and `option`
  // what the thickness came from, for messages.
  WallMaker(const TriangleSoup& solid, double thickness, Precision precision,
            std::string_view option, ProgressObserver* progress);

  // Throws LimitError where the thickness is too small beside the solid, Cancelled.
  [[nodiscard]] Cavities find() const;
  // Where tetrahedra are small, most triangles lie in one plane.
  void take_away_triangles(Cavities& found) const;

  // Of triangles of a mesh: how deep below the surface of the solid all of their points are.
  [[nodiscard]] Bounds measure(const TriangleSoup& mesh,
                               std::span<const std::uint32_t> triangles) const;

  [[nodiscard]] const Depth& depth() const { return depth_; }

 private:
  using Triangle = std::array<Vec3d, 3>;

  [[nodiscard]] bool take_away_some(Cavities& found, HalvedStage& progress) const;
  [[nodiscard]] std::vector<std::uint32_t> triangles_beside(const TriangleSoup& walls) const;
  [[nodiscard]] Piece piece_of(const Triangle& triangle) const;
  [[nodiscard]] bool is_proven(const Piece& piece, double error, DepthProver& prover) const;
  [[nodiscard]] bool holds(const Triangle& triangle, double error) const;
  [[nodiscard]] Bounds bounds_of(const Triangle& triangle) const;

  const TriangleSoup& solid_;
  double thickness_;
  Precision precision_;
  std::string_view option_;
  ProgressObserver* progress_;  // not owned
  double error_;                // of the thickness, before coordinates are rounded
  Depth depth_;
};

// Throws ValueError, about this option, where the length is too small beside the solid.
void check_length(const TriangleSoup& solid, double length, const std::string& option);

}  // namespace meshrepair::internal
