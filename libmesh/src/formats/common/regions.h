// SPDX-License-Identifier: MIT
// Names of triangles for formats that have one list of them.
#pragma once

#include <cstddef>

#include <mesh/attributes.h>

namespace meshrepair {

// How many of the names a triangle has.
[[nodiscard]] std::size_t used_names(const TriangleLabels& labels);

// Groups or objects, whichever are more; if they are as many, groups. Triangles without one have
// the name that the other list has for them.
[[nodiscard]] TriangleLabels regions_of(const Attributes& attributes);

// The triangles of each region in the order of its name, those without one at the end: positions
// in `order` where a list begins, and the end of the last.
struct SortedRegions {
  std::vector<std::uint32_t> order;
  std::vector<std::size_t> first;  // one for each name, one for none, and one more
};
[[nodiscard]] SortedRegions sort_by_region(const TriangleLabels& regions);

}  // namespace meshrepair
