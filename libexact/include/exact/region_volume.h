// SPDX-License-Identifier: MIT
// Does a set of half-spaces have a volume in common? By linear programming in three variables.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <exact/grid.h>
#include <exact/plane.h>

namespace meshrepair {

// The same plane with the normal turned round.
[[nodiscard]] Plane turned(const Plane& plane);

// Holds scratch memory between questions; one for each thread.
class RegionVolume {
 public:
  // All regions are inside the box, which has a volume.
  explicit RegionVolume(const GridBox& box);

  // Is there a point strictly on the positive side of each plane, and inside the box? Exact:
  // regions that meet only in a facet, an edge or a point have no volume. Linear in the number of
  // planes as a rule, quadratic at worst for each that cuts the last vertex off.
  [[nodiscard]] bool has_volume(std::span<const Plane> planes);

  // How many planes were looked at, and for how many of these a filter was not enough.
  [[nodiscard]] std::size_t looked_at() const { return looked_at_; }
  [[nodiscard]] std::size_t decided_exactly() const { return decided_exactly_; }

 private:
  using Index = std::size_t;

  // The common point of three planes, moved with them: see the .cpp.
  struct Vertex {
    std::array<Index, 3> planes{};
    std::array<double, 3> position{};
    double error = 0;  // infinite where the position is not known well enough to be of use
  };

  [[nodiscard]] bool solve_on_plane(Index h, Vertex& found);
  [[nodiscard]] bool start_on_plane(Index h, Vertex& found);
  [[nodiscard]] bool solve_on_line(Index h, Index g, Vertex& found);
  [[nodiscard]] bool passes_parallel(Index h, Index g, Index parallel);
  [[nodiscard]] Vertex vertex(Index a, Index b, Index c) const;
  [[nodiscard]] int turn(Index a, Index b, Index c) const;
  [[nodiscard]] bool is_inside(const Vertex& vertex, Index plane);

  std::vector<Plane> planes_;  // the box, then those asked for
  std::size_t looked_at_ = 0;
  std::size_t decided_exactly_ = 0;
};

}  // namespace meshrepair
