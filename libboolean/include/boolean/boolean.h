// SPDX-License-Identifier: MIT
// Union, intersection, difference and symmetric difference of solids (WM 6.1).
#pragma once

#include <span>
#include <vector>

#include <boolean/merge_trees.h>
#include <boolean/set_operation.h>
#include <repair/repair.h>

namespace meshrepair {

struct BooleanOptions {
  RegionTest test = RegionTest::cells;
  // Only boolean() looks at this: merges trees of all solids, which gives the same.
  bool by_trees = false;
  // How the result is extracted and certified; of the rest, the progress.
  RepairOptions repair;
};

struct OperandReport {
  CleanReport clean;  // on the grid of all operands
  BuildTreeReport tree;
  double volume = 0;  // as given, in the input's units, cubed
};

// Filled as far as the work came, also when it ended with an exception.
struct BooleanReport {
  std::vector<OperandReport> operands;
  std::vector<MergeReport> merges;  // one less; none where there were no trees
  RepairReport result;              // from the extraction on
};

// `solids` are closed surfaces without self-intersections, turned outward, as repair() returns
// them; one without triangles is the empty solid. At least one; from the first all others are
// subtracted, and more than two are excluded in turn. The tree's sources count through all
// operands. Throws InputError where a solid is nothing on the grid of 26 bits over all.
[[nodiscard]] Tree boolean_tree(std::span<const TriangleSoup> solids, SetOperation operation,
                                const BooleanOptions& options, BooleanReport& report);

// The same as a surface, which may be without triangles. Triangles that the operation does not cut
// come out bit for bit.
[[nodiscard]] Surface boolean(std::span<const TriangleSoup> solids, SetOperation operation,
                              const BooleanOptions& options, BooleanReport& report);

// The boundary of a tree that boolean_tree() made; without triangles where nothing is solid.
[[nodiscard]] Surface boolean_surface(const Tree& tree, const BooleanOptions& options,
                                      BooleanReport& report);

}  // namespace meshrepair
