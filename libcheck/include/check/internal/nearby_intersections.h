// SPDX-License-Identifier: MIT
// Which triangles of a mesh are near a few places, and which of them intersect while some of its
// points move by little.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Knows which triangles may meet those that move, as long as no point is farther than `margin` from
// where it was at first. Asking again costs what is near, not the mesh.
class NearbyIntersections {
 public:
  using Pair = std::array<std::uint32_t, 2>;

  // `moving` are triangles. The mesh must outlive it; its points may move, and nothing else.
  NearbyIntersections(const TriangleSoup& mesh, std::span<const std::uint32_t> moving,
                      double margin);

  // As self_intersections() of `among`, which are moving, with the points as they are now.
  [[nodiscard]] std::vector<Pair> find(std::span<const std::uint32_t> among,
                                       ProgressObserver* progress);

 private:
  [[nodiscard]] Box box_around(std::uint32_t triangle, double margin) const;
  void find_around(std::span<const std::uint32_t> moving, double margin);
  void add(std::uint32_t triangle);

  const TriangleSoup& mesh_;
  std::vector<std::uint32_t> around_;  // triangles near those that move, and these themselves
  std::vector<Box> boxes_;             // of each of them, wherever it goes
  BoxTree tree_;
  std::vector<std::uint32_t> part_index_;  // of each point of the mesh in part_, or kNone
  std::vector<char> is_in_part_;           // of each triangle of the mesh
  TriangleSoup part_;                      // what is near the triangles asked for; scratch
  std::vector<std::uint32_t> part_triangles_, part_points_;  // which of the mesh they are
};

// The triangles whose boxes, widened by `margin`, meet one of these, ascending; of two that are not
// finite nothing is said. Linear in the soup, with a small factor. The same for any number of
// threads.
[[nodiscard]] std::vector<std::uint32_t> triangles_near(const TriangleSoup& soup,
                                                        std::span<const Box> boxes, double margin);

}  // namespace meshrepair::internal
