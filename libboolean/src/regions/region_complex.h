// SPDX-License-Identifier: MIT
// Triangles between regions, which share corners and sides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <base/ids.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// What is in front of triangles and behind them.
using TriangleSides = std::vector<std::array<std::uint32_t, 2>>;

// As in ConformingBodies.
struct RegionComplex {
  TriangleSoup mesh;
  TriangleSides parts_of;
  std::vector<std::uint32_t> region_of_part;
  std::vector<std::uint32_t> source;

  [[nodiscard]] TriangleSides regions_of() const {
    TriangleSides regions;
    regions.reserve(parts_of.size());
    for (const auto& [front, behind] : parts_of) {
      regions.push_back({region_of_part[front], region_of_part[behind]});
    }
    return regions;
  }
};

// The region that is around all others.
inline constexpr std::uint32_t kOutside = 0;

// Turns triangles so that it is in front of those that it is beside.
void turn_outside_to_front(RegionComplex& complex);

// With other parts in place of some, and without triangles that are gone, which have no corners, or
// have the same region on both sides, and without points that no triangle has. The outside is in
// front.
[[nodiscard]] RegionComplex compacted(const RegionComplex& complex,
                                      const std::vector<std::uint32_t>& becomes);

// Of a part.
struct PartSize {
  std::uint32_t triangle = kNone;  // one that bounds it
  double volume = 0, area = 0;     // rounded

  [[nodiscard]] bool is_turned() const { return triangle != kNone && !(volume > 0); }
};

[[nodiscard]] std::vector<PartSize> sizes_of_parts(const RegionComplex& complex);

}  // namespace meshrepair::internal
