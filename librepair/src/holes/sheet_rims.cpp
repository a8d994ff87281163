// SPDX-License-Identifier: MIT
#include "sheet_rims.h"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "rim_plane.h"

namespace meshrepair::internal {
namespace {

// Of the end of a tube: the angle in radians to the plane of the rim, and the share of the rim that
// has it.
constexpr double kSteepEnd = 0.7;
constexpr double kMostOfEnd = 0.75;

// A patch of a smaller share of the sheet closes the end of a bore.
constexpr double kSmallEnd = 0.002;

// Whether the rim is as long as that of a flat disk of the sheet's area: what is folded or rolled
// has such a rim, what is hollow has not.
bool is_rim_of_disk(const Rim& rim, double sheet_area) {
  const double length = length_of(rim);
  return length * length >= 4 * std::numbers::pi * sheet_area;
}

bool may_be_end_of_tube(const Rim& rim, const RimOfSheet& end) {
  return end.patch_area > kSmallEnd * end.sheet_area &&
         share_steeper(rim, plane_of(rim), kSteepEnd) > kMostOfEnd;
}

}  // namespace

std::vector<char> find_sheet_rims(std::span<const Rim> rims, std::span<const RimOfSheet> ends) {
  std::vector<std::uint32_t> sheets_of_ends;
  std::vector<char> may_be_end(rims.size(), 0);
  for (std::size_t r = 0; r < rims.size(); ++r) {
    if (!may_be_end_of_tube(rims[r], ends[r])) continue;
    may_be_end[r] = 1;
    sheets_of_ends.push_back(ends[r].sheet);
  }
  std::sort(sheets_of_ends.begin(), sheets_of_ends.end());
  std::vector<char> found(rims.size(), 0);
  for (std::size_t r = 0; r < rims.size(); ++r) {
    const auto [first, last] =
        std::equal_range(sheets_of_ends.begin(), sheets_of_ends.end(), ends[r].sheet);
    const bool is_of_tube = may_be_end[r] != 0 && last - first > 1;
    found[r] = is_of_tube || is_rim_of_disk(rims[r], ends[r].sheet_area) ? 1 : 0;
  }
  return found;
}

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
