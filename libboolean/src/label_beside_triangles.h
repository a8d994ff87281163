// SPDX-License-Identifier: MIT
// Labels for the tree of a surface that bounds a solid, without making its cells.
#pragma once

#include <base/progress.h>
#include <bsp/tree.h>

namespace meshrepair::internal {

// Whether the triangles on the grid are the boundary of a solid: closed, manifold, outward, and
// nowhere crossing. Throws Cancelled.
[[nodiscard]] bool bounds_a_solid(const CleanSoup& soup, ProgressObserver* progress = nullptr);

// Labels all leaves of a tree that build_tree() made of such a soup, and returns true. A leaf has
// one label throughout, so the triangles on the last plane before it tell which (Thibault and
// Naylor 1987); where there are none, that the leaf reaches the end of space does. Returns false,
// the labels being undefined, where neither tells.
[[nodiscard]] bool label_beside_triangles(Tree& tree);

}  // namespace meshrepair::internal
