// SPDX-License-Identifier: MIT
// Which triangles of a mesh meet where they should not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair {

struct SelfIntersectionOptions {
  // Corners are shared if their coordinates are equal, as for a reader of STL. Otherwise if their
  // indices are: then triangles that touch in different points with equal coordinates intersect.
  bool weld = true;
  // Of listed triangles alone: those, too, that lie on each other in nearly one plane, no further
  // apart than this, as far as doubles tell. They count as coplanar. 0: none.
  double nearness = 0;
  std::size_t most_pairs = 1000;  // that are kept; all are counted
  // Stop where there are more: then how many, and which, may change from run to run.
  std::size_t enough = ~std::size_t{0};
  ProgressObserver* progress = nullptr;  // not owned; no stage is begun
};

struct SelfIntersections {
  // The first of all pairs in ascending order, each the lower triangle first.
  std::vector<std::array<std::uint32_t, 2>> pairs;
  std::size_t count = 0;     // of all pairs: the sum of the next three
  std::size_t crossing = 0;  // each triangle has points on both sides of the other's plane
  std::size_t touching = 0;  // not crossing, in different planes
  std::size_t coplanar = 0;  // overlapping in one plane; equal triangles too
  // Triangles that were left out, as they have no inside that could be met.
  std::size_t degenerate = 0;  // corners on a line, or in one point
  std::size_t not_finite = 0;  // a coordinate that is not a number, or infinite
};

// Counts the pairs of triangles that have more in common than the corners and the edge that they
// share: also those with a common corner that meet elsewhere too, and those folded onto each other
// at a common edge. Of faces that cross along an edge that both have with points of their own, one
// pair (welded only). Exact; the same for any number of threads. Throws Cancelled. n log n and the
// number of pairs that are near each other, whatever the shape of the triangles.
[[nodiscard]] SelfIntersections self_intersections(const TriangleSoup& soup,
                                                   const SelfIntersectionOptions& options = {});

// The pairs alone in which one of these triangles is, and of these triangles alone those that were
// left out: for checking again where a mesh was changed. `among` may repeat, and every entry is
// below soup.triangles.size(). Linear in the mesh, with a small factor, besides what the listed
// ones cost.
[[nodiscard]] SelfIntersections self_intersections(const TriangleSoup& soup,
                                                   std::span<const std::uint32_t> among,
                                                   const SelfIntersectionOptions& options = {});

}  // namespace meshrepair
