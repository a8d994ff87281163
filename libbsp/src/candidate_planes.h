// Choosing the plane of one of the fragments as a node's plane.
#pragma once

#include <span>

#include <bsp/build_tree.h>

#include "fragment_pool.h"

namespace meshrepair::internal {

// The plane of the fragment that cuts few others and leaves the sides in balance, found on samples.
// Judged by rounded distances: a wrong guess makes the tree larger, never wrong. `fragments` is not
// empty.
[[nodiscard]] PlaneId choose_fragment_plane(const FragmentPool& pool,
                                            std::span<const FragmentId> fragments,
                                            const BuildTreeOptions& options);

}  // namespace meshrepair::internal
