// Which holes are so large that what they are in is rather an open sheet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meshrepair::internal {

// A hole that may be patched.
struct Opening {
  std::uint32_t part = 0;  // that it is in
  double area = 0;         // of its patch
  double most = 0;         // that may be, as a share
};

// For each opening whether its patch has more than that share of the area of all else of its part,
// closed: of the surface that is there, part_area[part], and of the other patches. What is too
// large is no patch, so it is found from the largest one on. Takes n log n.
[[nodiscard]] std::vector<char> find_large_openings(std::span<const Opening> openings,
                                                    std::vector<double> part_area);

}  // namespace meshrepair::internal
