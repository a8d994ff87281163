// SPDX-License-Identifier: MIT
// Taking away what rounding made intersect or lose its area between regions, place by place.
#pragma once

#include <cstddef>

#include <base/progress.h>
#include <mesh/precision.h>

#include "region_complex.h"

namespace meshrepair::internal {

struct MendRegionsOptions {
  Precision precision = Precision::float64;  // of the coordinates, before and after
  double unit = 0;                           // by which points may move, at least
  ProgressObserver* progress = nullptr;      // not owned; no stage is begun
};

struct MendRegionsReport {
  std::size_t pairs_at_first = 0;  // that meet, and triangles without area
  std::size_t pairs = 0;           // that are left
  std::size_t turned_edges = 0;    // that are left (region_edges.h)
  std::size_t turned_parts = 0;    // that are left, inside out
  std::size_t edits = 0;           // of points that moved, and edges
  double distance = 0;             // by which they moved, at most
};

// Makes points one that lie near each other, leads edges over points, turns them, and moves points
// as mend_faults() does, as long as that leaves fewer faults. Triangles that come to have the same
// corners are one then, or none, so that the triangles of each region pass each side as often one
// way as the other, as before; parts between which that leaves no triangle are one. Nothing is done
// where very many triangles meet. Besides n log n it costs what is near the faults. Throws
// Cancelled.
void mend_regions(RegionComplex& complex, const MendRegionsOptions& options,
                  MendRegionsReport& report);

}  // namespace meshrepair::internal
