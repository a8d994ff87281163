// SPDX-License-Identifier: MIT
// A mesh some of whose edges and faces have points of other ones on them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <mesh/edge_table.h>
#include <mesh/soup.h>
#include <repair/join_gaps.h>

#include "face_pieces.h"

namespace meshrepair::internal {

// Of the way from a to b, where that is nearest to p: not limited to it.
[[nodiscard]] double share_along(const Vec3d& p, const Vec3d& a, const Vec3d& b);

struct NearMesh {
  struct Edge {
    EdgeEnds ends;
    std::vector<std::uint32_t> inner;  // points on it
  };

  std::vector<Vec3d> at;               // of each point, also new ones
  std::vector<std::uint32_t> name;     // of each point of the soup: the one it is now
  std::vector<IndexTriangle> corners;  // of each triangle
  std::vector<Edge> edges;             // of triangles that are near others, sorted by their ends
  std::vector<std::vector<std::uint32_t>> inner;  // of each triangle: points in it, ascending

  // Welded, without any edges.
  explicit NearMesh(const TriangleSoup& soup);

  // A position in `edges`; kNone if it is none of them.
  [[nodiscard]] std::uint32_t edge_between(std::uint32_t a, std::uint32_t b) const;
  // The points from one end of an edge to before the other.
  [[nodiscard]] std::vector<std::uint32_t> along(std::uint32_t from, std::uint32_t to) const;
};

inline bool has(const std::vector<std::uint32_t>& list, std::uint32_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

// Triangles are cut along edges between points that they have. The report gets what became of
// points.
[[nodiscard]] JoinedSoup cut_near_mesh(const TriangleSoup& soup, const NearMesh& mesh,
                                       JoinGapsReport& report, CancelCheck& check);

}  // namespace meshrepair::internal
