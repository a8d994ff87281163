// SPDX-License-Identifier: MIT
// What an indexed triangle mesh is as a surface: the one oracle for input, output and tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mesh/edge_table.h>
#include <mesh/soup.h>

namespace meshrepair {

// Two triangles share an edge if they share the indices of its ends; coordinates play no part.
struct Topology {
  std::size_t triangles = 0;
  std::size_t edges = 0;
  std::size_t open_edges = 0;          // one triangle
  std::size_t nonmanifold_edges = 0;   // more than two
  std::size_t inconsistent_edges = 0;  // two that pass it in the same direction
  // More than one fan of triangles that are joined at edges of the vertex: they touch in it alone.
  std::size_t nonmanifold_vertices = 0;
  std::size_t repeated_corners = 0;  // triangles with two equal corners
  std::size_t parts = 0;             // connected through edges

  [[nodiscard]] bool closed() const { return triangles > 0 && open_edges == 0; }
  [[nodiscard]] bool manifold() const {
    return nonmanifold_edges == 0 && nonmanifold_vertices == 0 && repeated_corners == 0;
  }
  [[nodiscard]] bool oriented() const { return inconsistent_edges == 0; }
};

// Where the counts of a Topology come from. Sides are those of EdgeTable.
struct TopologyPlaces {
  std::vector<std::uint32_t> open_sides;
  std::vector<std::uint32_t> nonmanifold_sides;   // all of each such edge, one edge after the other
  std::vector<std::uint32_t> inconsistent_sides;  // both of each such edge
  std::vector<std::uint32_t> nonmanifold_vertices;
  std::vector<std::uint32_t>
      parts;  // of each triangle: 0 to Topology::parts - 1, by first triangle
};

// Every index is below `points`. `places`, unless null, is filled, with points in ascending order.
[[nodiscard]] Topology examine_topology(std::span<const IndexTriangle> triangles,
                                        std::size_t points, TopologyPlaces* places = nullptr);

// Of each triangle, whether its part, connected through edges, has an edge with one triangle.
// Indices are below `points`.
[[nodiscard]] std::vector<char> triangles_of_open_parts(std::span<const IndexTriangle> triangles,
                                                        std::size_t points);

// Signed volume (positive when the triangles are counter-clockwise seen from outside) and area, in
// the input's units.
[[nodiscard]] double signed_volume(const TriangleSoup& soup);
[[nodiscard]] double surface_area(const TriangleSoup& soup);

}  // namespace meshrepair
