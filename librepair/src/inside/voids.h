// SPDX-License-Identifier: MIT
// Hollow spaces that no way leads into from outside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/ids.h>
#include <base/progress.h>
#include <repair/cell_graph.h>

namespace meshrepair::internal {

// Makes every cell solid that infinity cannot be reached from through cells that are not. Returns
// how many separate voids that filled.
std::size_t fill_voids(const CellGraph& graph, std::vector<char>& solid,
                       ProgressObserver* progress);

struct Voids {
  std::vector<char> marked;  // of each cell
  std::size_t count = 0;
};

// Which cells that are `empty` by parity lie in a void rather than where shells overlap, of those
// that are `inside`, out of the flood's reach. They form regions bounded by triangles. Such a
// region is a void if every part of the surface that touches it lies wholly on its border, like the
// wall of a cavity or a shell inside of one: two shells that overlap also have triangles elsewhere.
[[nodiscard]] Voids find_voids(const CellGraph& graph, const std::vector<char>& inside,
                               const std::vector<char>& empty,
                               const IdVector<TriangleId, std::uint32_t>& part_of,
                               ProgressObserver* progress);

}  // namespace meshrepair::internal
