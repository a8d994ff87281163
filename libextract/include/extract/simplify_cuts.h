// SPDX-License-Identifier: MIT
// Fewer triangles where cutting left slivers and crumbs, within a bound that holds.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <base/progress.h>
#include <extract/surface.h>

namespace meshrepair {

struct SimplifyOptions {
  // How far the new surface may be from the one before, anywhere; in the mesh's units. 0: as it is.
  double within = 0;
  // Where triangles carry more than their places: of each triangle of the input, how far a point in
  // which its result meets that of others may move over it. Not owned. Empty: as far as `within`.
  std::span<const double> reach = {};
  ProgressObserver* progress = nullptr;  // not owned; no stage is begun
};

struct SimplifyReport {
  std::size_t removed_points = 0;
  std::size_t removed_triangles = 0;
  double distance = 0;             // no point of the surface is farther from the one before
  std::size_t rounds = 0;          // until no triangles met that did not before
  std::size_t points_to_stay = 0;  // more than at first, as they would have made triangles meet
};

// Moves points of a closed manifold surface onto neighbours, the nearest first, as long as every
// point of the new surface is within the bound of the old one: it adds the largest distances
// between the stars before and after, one over the other (J. Cohen, D. Manocha and M. Olano:
// Simplifying polygonal models using successive mappings, 1997).
//
// Points with a flag in `stays` (one for each) stay, and those in which parts touch; they get a
// flag too, as do those whose moves would make triangles meet. With these a surface that differs
// little takes fewer rounds. A part that is hardly thicker than the bound has a bound of a share of
// its thickness. There are no new points and no degenerate triangles. The surface stays closed and
// manifold, of the same genus; changed triangles meet no others (exactly tested, with equal points
// as one); no part faces another way, or changes its volume by over a tenth. Sources and flags of
// points go along. With SimplifyOptions::reach, a line where two sources meet, and a point where
// three do, moves by no more than the least of these. Returns nothing where nothing can go, or
// where all that takes too many rounds. Throws Cancelled. n log n; stars of very many triangles
// stay.
[[nodiscard]] std::optional<Surface> simplify_cuts(const Surface& surface, std::vector<char>& stays,
                                                   const SimplifyOptions& options,
                                                   SimplifyReport& report);

}  // namespace meshrepair
