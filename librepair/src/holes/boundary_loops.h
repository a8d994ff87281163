// SPDX-License-Identifier: MIT
// The closed walks along the border of a soup.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

// A side of a triangle where the surface ends.
struct BorderEdge {
  std::uint32_t low = 0, high = 0;  // its points
  std::uint32_t side = 0;           // of the first triangle there
  bool open = false;                // there is no other triangle
};

// Loop l has the points point[first[l]] to point[first[l + 1] - 1], all different; edge[i] runs
// from point i to the next one of its loop. It starts at its lowest point and goes on to the lower
// one of that point's neighbours, so it does not depend on how the triangles are turned.
struct BoundaryLoops {
  std::vector<BorderEdge> edges;
  std::vector<std::size_t> first = {0};
  std::vector<std::uint32_t> point;
  std::vector<std::uint32_t> edge;
  std::size_t stray_edges = 0;  // on no loop

  [[nodiscard]] std::size_t loops() const { return first.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> points_of(std::size_t loop) const {
    return {point.data() + first[loop], first[loop + 1] - first[loop]};
  }
  [[nodiscard]] std::span<const std::uint32_t> edges_of(std::size_t loop) const {
    return {edge.data() + first[loop], first[loop + 1] - first[loop]};
  }
};

// The border is where an odd number of triangles meet: that is always a set of loops, also where
// three or more meet, and however they are turned. Loops without an open edge are left out: they
// are rims of walls, and nothing is missing there; so are edges of dividers (dividers.h).
// `triangles` are those of the soup.
[[nodiscard]] BoundaryLoops find_boundary_loops(const CleanSoup& soup,
                                                std::span<const IndexTriangle> triangles,
                                                const EdgeTable& table, ProgressObserver* progress);

// The same of other edges than the border: all that are open are where the surface is to end.
[[nodiscard]] BoundaryLoops walk_border(const CleanSoup& soup,
                                        std::span<const IndexTriangle> triangles,
                                        const EdgeTable& table, std::vector<BorderEdge> border,
                                        ProgressObserver* progress);

// Puts loops behind those that are there.
void append_loops(BoundaryLoops& loops, const BoundaryLoops& more);

}  // namespace meshrepair::internal
