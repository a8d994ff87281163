// SPDX-License-Identifier: MIT
// The flood from infinity (WM 6.2).
#pragma once

#include <vector>

#include <base/progress.h>
#include <repair/cell_graph.h>

namespace meshrepair::internal {

// 1 for the cells that cannot be reached from outside the box through cells with `empty` set,
// without passing an opaque link: the inside. `progress` is asked whether to go on.
[[nodiscard]] std::vector<char> flood_from_infinity(const CellGraph& graph,
                                                    const std::vector<char>& empty,
                                                    ProgressObserver* progress = nullptr);

}  // namespace meshrepair::internal
