// SPDX-License-Identifier: MIT
// Places of a closed surface, cut out and closed, so that each one is a small body.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <base/progress.h>
#include <mesh/precision.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

struct CappedPlaces {
  // The bodies: first the triangles of the places, in the order of the mesh, then the caps, cones
  // from each rim to a point of their own behind the surface. No cap meets another triangle but
  // where they share corners and edges.
  TriangleSoup soup;
  std::vector<std::uint32_t> triangle;  // of the mesh, of each that is no cap's
  std::vector<std::uint32_t> point;     // of the mesh, of each that is no tip of a cap
};

// `mesh` is closed, manifold and oriented; `seeds` are the triangles at fault, each of which is in
// a place with all triangles around it. Tips have coordinates of that precision. Nothing where a
// rim is not simple, no cap is found for it, or places have more than `most` triangles. Throws
// Cancelled.
[[nodiscard]] std::optional<CappedPlaces> cap_places(const TriangleSoup& mesh,
                                                     std::span<const std::uint32_t> seeds,
                                                     std::size_t most, Precision precision,
                                                     ProgressObserver* progress);

}  // namespace meshrepair::internal
