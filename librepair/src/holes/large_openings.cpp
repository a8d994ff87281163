#include "large_openings.h"

#include <algorithm>
#include <numeric>

namespace meshrepair::internal {

std::vector<char> find_large_openings(std::span<const Opening> openings,
                                      std::vector<double> part_area) {
  std::vector<std::size_t> by_size(openings.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) {
    return openings[a].area > openings[b].area;
  });
  for (const Opening& opening : openings) part_area[opening.part] += opening.area;
  std::vector<char> large(openings.size(), 0);
  for (const std::size_t i : by_size) {
    const Opening& opening = openings[i];
    const double rest = part_area[opening.part] - opening.area;
    if (opening.area <= opening.most * rest) continue;
    large[i] = 1;
    part_area[opening.part] = rest;
  }
  return large;
}

}  // namespace meshrepair::internal
