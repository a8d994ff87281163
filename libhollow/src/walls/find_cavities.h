// SPDX-License-Identifier: MIT
// The parts of a solid that are deeper below its surface than a thickness.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <base/progress.h>

#include "common/depth.h"

namespace meshrepair::internal {

struct CavityOptions {
  double thickness = 0;
  double error = 0;                      // how much deeper, or less deep, a point of a wall may be
  std::string_view option;               // that the thickness came from, for messages
  ProgressObserver* progress = nullptr;  // not owned
};

struct Cavities {
  // Closed and free of self-intersections, turned out of the cavities.
  TriangleSoup walls;
  std::vector<std::uint32_t> cavity;  // of each triangle
  std::vector<Place> deepest;         // of each cavity, nearly
  std::size_t cells = 0;              // tetrahedra
  double finest = 0;                  // the shortest longest edge of one that a wall passes
  // Where no proof was found that walls are as deep as they are to be, and that all that is deeper
  // is in a cavity.
  std::size_t unproven = 0;
};

// Throws LimitError where that takes too many tetrahedra, Cancelled. The same for any number of
// threads.
[[nodiscard]] Cavities find_cavities(const TriangleSoup& solid, const Depth& depth,
                                     const CavityOptions& options);

}  // namespace meshrepair::internal
