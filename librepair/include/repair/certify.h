// SPDX-License-Identifier: MIT
// Making sure that the coordinates as they are written bound a solid, and mending them where not:
// what can be asked, and what is told.
#pragma once

#include <cstddef>

#include <extract/cut_nonmanifold.h>
#include <mesh/precision.h>

namespace meshrepair {

struct CertifyOptions {
  bool wanted = true;
  Precision precision = Precision::float64;
  // The format has no indices, as STL: points with equal coordinates are one to its readers. Then
  // solids that touch are moved apart, or made to overlap where they were joined along an edge, by
  // a few units in the last place.
  bool welded = false;
  Touching touching = Touching::separate;  // of the surface; repair() sets it to that of `extract`
  // How often the places that fail may be brought onto a coarser grid and repaired again. 0: they
  // are left as they are, but for solids that a format without indices would join.
  std::size_t most_rounds = 6;
  // With more triangles that intersect than so many pairs, once rounded, no point is moved, either.
  std::size_t most_pairs_at_first = ~std::size_t{0};
};

// So many pairs may be chance in a surface of so many triangles: of more the surface is finer than
// the numbers. Of large meshes it takes more to say so: they have more places where faces cross,
// and what is left to cells takes far longer.
[[nodiscard]] constexpr std::size_t pairs_by_chance(std::size_t triangles) {
  constexpr std::size_t kAlways = 32, kLarge = 1 << 18, kTrianglesOfPair = 256;
  return triangles > kLarge ? kAlways + (triangles - kLarge) / kTrianglesOfPair : kAlways;
}

struct CertifyReport {
  bool done = false;                 // the test ran to its end
  std::size_t pairs_at_first = 0;    // of triangles that intersected once rounded, thin parts apart
  std::size_t pairs = 0;             // that are left
  std::size_t degenerate = 0;        // triangles without area, in the end
  std::size_t rounds = 0;            // of mending
  std::size_t snapped_points = 0;    // moved onto a grid in the last of them, of each group
  std::size_t dropped_parts = 0;     // that rounding flattened or turned
  double dropped_share = 0;          // of the area at first, where parts were dropped
  std::size_t joined_points = 0;     // that a welding format still joins with others
  std::size_t inside_out_parts = 0;  // that are left, known where no triangles intersect

  [[nodiscard]] std::size_t faults() const {
    return pairs + degenerate + joined_points + inside_out_parts;
  }
  [[nodiscard]] bool passed() const { return done && faults() == 0; }
};

}  // namespace meshrepair
