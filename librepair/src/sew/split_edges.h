// SPDX-License-Identifier: MIT
// Triangles get corners that lie beside their open edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/ids.h>
#include <bsp/clean_soup.h>
#include <mesh/soup.h>

#include "corner_clusters.h"
#include "open_rims.h"
#include "strangers.h"

namespace meshrepair::internal {

// A corner on the side of a triangle.
struct EdgeSplit {
  std::uint32_t side;
  double share;  // of the way along it
  std::uint32_t corner;
};

// Those within the distance, and within this share of the edges at the corner, that are in no
// cluster with a corner of the triangle. Sorted by side and share; of corners of one cluster beside
// one side, the first.
[[nodiscard]] std::vector<EdgeSplit> find_splits(const OpenRims& rims, const Strangers& strangers,
                                                 const CornerClusters& clusters, double distance,
                                                 double share);

// The triangle in pieces: a fan for each side with new corners.
[[nodiscard]] std::vector<IndexTriangle> split_triangle(const IndexTriangle& triangle,
                                                        const EdgeSplit* first,
                                                        const EdgeSplit* last);

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
