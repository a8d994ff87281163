// Fewer triangles where cutting left slivers and crumbs, within a bound that holds.
#pragma once

#include <cstddef>
#include <vector>

#include <bsp/progress.h>
#include <extract/surface.h>

namespace meshrepair {

struct SimplifyOptions {
  // How far the new surface may be from the one before, anywhere; in the mesh's units. 0: as it is.
  double within = 0;
  ProgressObserver* progress = nullptr;  // not owned; no stage is begun
};

struct SimplifyReport {
  std::size_t removed_points = 0;
  std::size_t removed_triangles = 0;
  double distance = 0;             // no point of the surface is farther from the one before
  std::size_t rounds = 0;          // until no triangles met that did not before
  std::size_t points_to_stay = 0;  // as they would have made triangles meet
};

// Moves points of a closed manifold surface onto neighbours, the nearest first, as long as every
// point of the new surface is within the bound of the old one: it adds the largest distances
// between the stars before and after, one over the other (J. Cohen, D. Manocha and M. Olano:
// Simplifying polygonal models using successive mappings, 1997). Triangles with a flag in `whole`
// (one for each) stay, and the points that have some; so what was never cut is as it was. No new
// points, no degenerate triangles; the surface stays closed and manifold, of the same genus, and no
// triangles meet that have been changed, and no part faces another way (exactly tested, with equal
// points as one); where that takes too many rounds, nothing is. Sources and flags of points go
// along. Throws Cancelled. n log n but for points of very many triangles, which stay.
void simplify_cuts(Surface& surface, const std::vector<char>& whole, const SimplifyOptions& options,
                   SimplifyReport& report);

}  // namespace meshrepair
