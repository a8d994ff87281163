// Triangles of a clean soup in pieces.
#pragma once

#include <cstddef>
#include <vector>

#include <base/ids.h>
#include <bsp/clean_soup.h>
#include <mesh/soup.h>

#include "split_edges.h"

namespace meshrepair::internal {

struct TriangleInPieces {
  TriangleId triangle;
  std::size_t first_split = 0, end_split = 0;  // of the list
  std::vector<IndexTriangle> corners;          // of each piece
};

// Of each triangle that a split is of. `splits` are sorted by sides, and along these.
[[nodiscard]] std::vector<TriangleInPieces> split_triangles(const CleanSoup& soup,
                                                            const std::vector<EdgeSplit>& splits);

// Pieces take the places of their triangles.
void put_in(CleanSoup& soup, const std::vector<TriangleInPieces>& split);

}  // namespace meshrepair::internal
