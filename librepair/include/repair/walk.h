// SPDX-License-Identifier: MIT
// The exact answer, where there is one: walking from infinity through the cells and counting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <repair/cell_graph.h>

namespace meshrepair {

struct Walk {
  std::vector<std::int32_t> value;  // of each cell
  std::size_t contradictions = 0;   // links whose ends do not differ as the link says
  [[nodiscard]] bool consistent() const { return contradictions == 0; }
};

// Both ask `progress` whether to go on.
//
// Parity: 0 outside, changing at every opaque link. Solidity's optimum is 2 * value - 1 when
// consistent.
[[nodiscard]] Walk walk_parity(const CellGraph& graph, ProgressObserver* progress = nullptr);

// Winding number: 0 outside, value(below) - value(above) = winding of the link. The winding optimum
// when consistent.
[[nodiscard]] Walk walk_winding(const CellGraph& graph, ProgressObserver* progress = nullptr);

}  // namespace meshrepair
