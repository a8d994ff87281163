// SPDX-License-Identifier: MIT
// Choosing the plane of one of the fragments as a node's plane.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <bsp/build_tree.h>

#include "fragment_pool.h"

namespace meshrepair::internal {

struct FragmentPlane {
  PlaneId plane;
  std::size_t cost = 0;
};

// The plane of the fragment that cuts few others and leaves the sides in balance, found on samples.
// Judged by rounded distances: a wrong guess makes the tree larger, never wrong. `fragments` is not
// empty.
[[nodiscard]] FragmentPlane choose_fragment_plane(const FragmentPool& pool,
                                                  std::span<const FragmentId> fragments,
                                                  const BuildTreeOptions& options);

// The same for planes through edges of the fragments' triangles, across the triangles: around a
// vertex with very many triangles neither an axis nor any triangle's own plane separates them, but
// such a plane does. Nothing if none costs less than `to_beat`. Whether the plane cuts the region
// has to be seen from the exact sides.
[[nodiscard]] std::optional<Plane> choose_edge_plane(const FragmentPool& pool,
                                                     const CleanSoup& soup,
                                                     std::span<const FragmentId> fragments,
                                                     const BuildTreeOptions& options,
                                                     std::size_t to_beat);

}  // namespace meshrepair::internal
