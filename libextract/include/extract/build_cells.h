// SPDX-License-Identifier: MIT
// From a tree to its cell complex (WM Procedures 1 and 2).
#pragma once

#include <base/progress.h>
#include <bsp/tree.h>
#include <extract/cell_complex.h>
#include <extract/clip_cell.h>

namespace meshrepair {

struct BuildCellsOptions {
  // Null: exact predicates.
  PredicateEngine* engine = nullptr;
  // Prove all invariants of both parts after every cut: for tests, some hundred times slower.
  bool check_every_clip = false;
  ProgressObserver* progress = nullptr;
};

// One cell for each leaf: cell i is not leaf i, but cells[i].leaf names it. `tree` must outlive the
// complex. Throws InputError when the engine is exact and a node's plane does not cut its region,
// which can only be so for a tree that build_tree() did not make.
[[nodiscard]] CellComplex build_cells(const Tree& tree, const BuildCellsOptions& options,
                                      ClipReport& report);

}  // namespace meshrepair
