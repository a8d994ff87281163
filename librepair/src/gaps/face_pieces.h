// SPDX-License-Identifier: MIT
// Triangles are cut along edges that lie in them, such that what two of them have in common is cut
// the same way.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <mesh/edge_table.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

using EdgeEnds = std::array<std::uint32_t, 2>;

[[nodiscard]] inline EdgeEnds ascending(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

class FacePieces {
 public:
  // The points have to live as long.
  explicit FacePieces(const std::vector<Vec3d>& points) : points_(points) {}

  // Appends triangles that together have this outline, which turns to the left as seen against the
  // normal but for rounding; what it passes both ways is not of it. Edges inside it, each given
  // once, meet each other and the outline in their ends alone. A region between edges that an
  // earlier outline had, too, gets the same triangles, turned round where it is. False where the
  // edges do cross: then they are left out.
  bool cut(std::span<const std::uint32_t> outline, std::span<const EdgeEnds> inside,
           const Vec3d& normal, std::vector<IndexTriangle>& pieces);

 private:
  using Loop = std::vector<std::uint32_t>;
  struct Region {
    Loop outline;  // the first time
    std::vector<IndexTriangle> pieces;
  };

  void fill(const Loop& loop, std::vector<Loop> holes, const Vec3d& normal,
            std::vector<IndexTriangle>& pieces);

  const std::vector<Vec3d>& points_;
  std::map<std::vector<EdgeEnds>, Region> known_;  // by their edges
};

}  // namespace meshrepair::internal
