// SPDX-License-Identifier: MIT
// Faces that nearly touch, and walls that are thin.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair {

struct NearFaces {
  std::uint32_t a = 0, b = 0;  // triangles, a < b
  double apart = 0;  // of a gap the largest distance where they overlap, of a wall the least
};

struct NearFacesFound {
  // With nothing solid in between, or of two bodies: they face each other, or one ends in or beside
  // the other.
  std::vector<NearFaces> gaps;
  // With what is solid in between.
  std::vector<NearFaces> walls;
};

struct NearFacesOptions {
  double largest_distance = 0;  // what is farther apart is not looked for
  // Nor what is farther apart than this share of the longest edges of both.
  double share = std::numeric_limits<double>::infinity();
  ProgressObserver* progress = nullptr;
};

// Pairs of triangles that are nearly parallel and overlap as seen along their normals, in a region
// wider than they are apart. Bodies are connected through edges of two triangles; one that faces
// inward is a void, and what is between it and another one solid. Numbers are rounded. n log n but
// for pairs whose boxes meet. Throws Cancelled.
[[nodiscard]] NearFacesFound find_near_faces(const TriangleSoup& soup,
                                             const NearFacesOptions& options);

}  // namespace meshrepair
