// SPDX-License-Identifier: MIT
// Trees without needless nodes.
#pragma once

#include <bsp/tree.h>

namespace meshrepair::internal {

// The same solid: nodes whose children are leaves with one label become such a leaf, until there
// are none. Linear.
[[nodiscard]] Tree collapse_tree(Tree tree);

}  // namespace meshrepair::internal
