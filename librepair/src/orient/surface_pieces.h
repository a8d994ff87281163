// SPDX-License-Identifier: MIT
// Pieces of surface that can only be turned round as a whole.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

// What can be added up over triangles that are turned alike. Turning all of them round is
// turned_round().
struct SurfaceSum {
  double area = 0;         // of all triangles, twice, in square grid steps
  double kept = 0;         // area of the triangles that are turned as they were given ...
  double turned = 0;       // ... and of those that are not; those that say nothing count in neither
  Int128 six_volumes = 0;  // of the tetrahedra over the origin of the grid
  std::array<Int128, 3> normal{};  // twice the vector area
  GridPoint low{kGridRadius, kGridRadius, kGridRadius};
  GridPoint high{-kGridRadius, -kGridRadius, -kGridRadius};

  void add(const SurfaceSum& other);
  [[nodiscard]] SurfaceSum turned_round() const;
  // The sign of the volume of the cone over the surface, seen from the middle of its box: 1 when it
  // faces outward. Exact, and for a closed surface the same from anywhere.
  [[nodiscard]] int outward() const;
  // Whether its holes are small beside it: what closes them has the surface's vector area, turned
  // round.
  [[nodiscard]] bool nearly_closed() const;
};

// Triangles connected through edges with exactly two triangles.
struct SurfacePiece {
  SurfaceSum sum;
  bool orientable = true;    // if not, as few of its edges contradict as was found
  bool closes_holes = true;  // none of its triangles is of the input
  bool doubled = true;       // all those that are, are there both ways round
};

struct SurfacePieces {
  std::vector<SurfacePiece> pieces;
  std::vector<std::uint32_t> of;  // of each triangle
  std::vector<char> turned;       // of each triangle: against the order of its corners
};

// The pieces, the triangles of each turned the same way round: as that turns the smaller area.
[[nodiscard]] SurfacePieces find_pieces(const CleanSoup& soup,
                                        std::span<const IndexTriangle> triangles,
                                        const EdgeTable& table, ProgressObserver* progress);

// How the triangle's normal, in the order of its corners, lies to that of its plane: 1 or -1.
[[nodiscard]] std::int32_t side_of_corners(const CleanSoup& soup, TriangleId t);

}  // namespace meshrepair::internal
