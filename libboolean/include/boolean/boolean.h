// Union, intersection, difference and symmetric difference of solids (WM 6.1).
#pragma once

#include <boolean/merge_trees.h>
#include <boolean/set_operation.h>
#include <span>
#include <vector>

#include <repair/repair.h>

namespace meshrepair {

struct BooleanOptions {
  RegionTest test = RegionTest::cells;
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
  std::vector<MergeReport> merges;  // one less
  RepairReport result;              // from the extraction on
};

// `solids` are closed surfaces without self-intersections, turned outward, as repair() returns
// them; one without triangles is the empty solid. At least one; the difference is of the first and
// all others, and so is the symmetric difference, in turn. Triangles that the operation does not
// cut come out bit for bit; Surface::source counts through all operands. The result may be without
// triangles. Throws InputError where one of them is nothing on the grid of 26 bits over all.
[[nodiscard]] Surface boolean(std::span<const TriangleSoup> solids, SetOperation operation,
                              const BooleanOptions& options, BooleanReport& report);

}  // namespace meshrepair
