// SPDX-License-Identifier: MIT
// Which triangles meet in meshes that differ little from each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <check/internal/triangle_list.h>
#include <check/self_intersections.h>
#include <mesh/edge_table.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Remembers the triangles of the last mesh that met nothing, by where their corners are. What is
// found is what self_intersections() finds, welded; the work is for triangles that the last mesh
// did not have, and for those that met others in it, besides passes that are linear in the mesh.
class KnownIntersections {
 public:
  KnownIntersections(std::size_t most_pairs, ProgressObserver* progress);
  KnownIntersections(const KnownIntersections&) = delete;
  KnownIntersections& operator=(const KnownIntersections&) = delete;

  // Throws Cancelled.
  [[nodiscard]] SelfIntersections find(const TriangleSoup& mesh);

 private:
  [[nodiscard]] SelfIntersections compare(const SoupCorners& corners) const;
  [[nodiscard]] std::vector<std::uint32_t> find_fresh(
      const std::vector<IndexTriangle>& triangles) const;
  [[nodiscard]] std::uint32_t find_known(const IndexTriangle& places) const;
  void remember(const TriangleSoup& mesh, const SoupCorners& corners,
                const std::vector<char>& doubtful);

  SelfIntersectionOptions options_;
  std::vector<Vec3d> points_;          // of the last mesh
  std::vector<std::uint32_t> places_;  // of each of them the first one that is there
  // Of the triangles that met nothing, by their lowest corner: where those of each begin, and the
  // two others, in order. Corners are first points in their places. A triangle that is there twice
  // met its copy.
  std::vector<std::uint32_t> first_;
  std::vector<std::array<std::uint32_t, 2>> others_;
};

}  // namespace meshrepair::internal
