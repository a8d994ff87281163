// SPDX-License-Identifier: MIT
// Two clean soups on one grid as one.
#pragma once

#include <cstddef>
#include <cstdint>

#include <bsp/clean_soup.h>

namespace meshrepair::internal {

// Where the second soup's elements are in the joined one; those of the first keep their ids, but
// for triangles.
struct JoinMap {
  IdVector<TriangleId, TriangleId> first_triangle, second_triangle;
  IdVector<PlaneId, PlaneId> second_plane;
};

// Points, planes and triangles that are in both are there once, as those of the first. Sources of
// the second soup count up from `second_source`. Throws InputError if the grids differ.
[[nodiscard]] CleanSoup join_soups(const CleanSoup& first, const CleanSoup& second,
                                   std::uint32_t second_source, JoinMap& map);

}  // namespace meshrepair::internal
