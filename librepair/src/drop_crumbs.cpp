#include "drop_crumbs.h"

#include <span>

#include <bsp/disjoint_sets.h>
#include <bsp/edge_table.h>

namespace meshrepair {

std::size_t drop_crumbs(std::vector<VotedTriangle>& triangles, std::size_t fewest) {
  std::vector<IndexTriangle> corners;
  corners.reserve(triangles.size());
  for (const VotedTriangle& triangle : triangles) corners.push_back(triangle.corners);
  DisjointSets parts(triangles.size());
  std::vector<std::uint32_t> rim;  // a triangle of each open edge
  EdgeTable(corners).for_each_edge([&](std::span<const std::uint32_t> sides) {
    for (const std::uint32_t side : sides) parts.join(sides[0] / 3, side / 3);
    if (sides.size() == 1) rim.push_back(sides[0] / 3);
  });
  std::vector<std::size_t> size(triangles.size(), 0);
  std::vector<char> open(triangles.size(), 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) ++size[parts.root(t)];
  for (const std::uint32_t t : rim) open[parts.root(t)] = 1;
  std::size_t kept = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t part = parts.root(t);
    if (open[part] == 0 || size[part] >= fewest) triangles[kept++] = triangles[t];
  }
  const std::size_t dropped = triangles.size() - kept;
  triangles.resize(kept);
  return dropped;
}

}  // namespace meshrepair
