// SPDX-License-Identifier: MIT
// Which parts of a closed surface face the wrong way? Exactly.
#pragma once

#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair {

struct PartOrientation {
  std::vector<std::uint32_t> part_of;  // of each triangle
  std::vector<std::uint32_t> depth;    // of each part: how many others lie around it
  std::vector<std::uint32_t> around;  // of each part: the innermost of these; kNone: there are none
  std::vector<char> inside_out;       // of each part: 1 if it faces the wrong way
};

// A part faces outward if an even number of others lies around it; if an odd one, it is the wall of
// a cavity and faces inward. Pre: a closed, oriented 2-manifold of finite coordinates, in which
// triangles meet in corners and edges alone. `progress` is asked whether to go on; it may be null.
[[nodiscard]] PartOrientation examine_part_orientation(const TriangleSoup& mesh,
                                                       ProgressObserver* progress);

}  // namespace meshrepair
