// SPDX-License-Identifier: MIT
#include "loose_regions.h"

#include <algorithm>
#include <tuple>

#include <Eigen/Geometry>

#include <base/ids.h>

namespace meshrepair::internal {
namespace {

// Of each region whether it has an outline of three corners and more, and no outline of less.
std::vector<char> sound_regions(const Boundary& boundary, const ManifoldCorners& corners,
                                const MergedFacets& merged) {
  std::vector<std::uint32_t> fewest_corners(merged.regions(), kNone);
  std::vector<char> seen(boundary.sides(), 0);
  for (std::uint32_t start = 0; start < boundary.sides(); ++start) {
    if (merged.dissolved[start] != 0 || seen[start] != 0) continue;
    std::uint32_t count = 0;
    for (std::uint32_t s = start; seen[s] == 0; s = merged.next_on_outline(boundary, corners, s)) {
      seen[s] = 1;
      count += merged.kept[corners.vertex[s]] != 0;
    }
    std::uint32_t& fewest = fewest_corners[merged.region[boundary.polygon[start]]];
    fewest = std::min(fewest, count);
  }
  std::vector<char> sound(merged.regions());
  for (std::size_t r = 0; r < sound.size(); ++r) {
    sound[r] = fewest_corners[r] != kNone && fewest_corners[r] >= 3;
  }
  return sound;
}

struct Passage {
  std::uint32_t low, high;  // vertices
  std::uint32_t triangle;
  bool upward;
};

}  // namespace

bool set_apart_odd_regions(const Boundary& boundary, const ManifoldCorners& corners,
                           const MergedFacets& merged, std::vector<char>& alone) {
  std::vector<char> sound = sound_regions(boundary, corners, merged);
  for (std::uint32_t p = 0; p < boundary.polygons(); ++p) {
    if (boundary.first[p + 1] - boundary.first[p] < 3) sound[merged.region[p]] = 0;
  }
  bool any = false;
  for (std::uint32_t p = 0; p < boundary.polygons(); ++p) {
    if (sound[merged.region[p]] != 0 || alone[p] != 0) continue;
    alone[p] = 1;
    any = true;
  }
  return any;
}

void separate_common_ends(const Boundary& boundary, const ManifoldCorners& corners,
                          const MergedFacets& merged, MiddleVertices& middles) {
  using Ends = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;
  std::vector<Ends> edges;
  for (std::uint32_t s = 0; s < boundary.sides(); ++s) {
    const std::uint32_t a = corners.vertex[s];
    const std::uint32_t b = corners.vertex[boundary.next(s)];
    if (merged.dissolved[s] != 0 || corners.mate[s] < s) continue;
    if (merged.kept[a] == 0 || merged.kept[b] == 0) continue;
    edges.emplace_back(std::min(a, b), std::max(a, b), s);
  }
  std::sort(edges.begin(), edges.end());
  const auto same_ends = [](const Ends& x, const Ends& y) {
    return std::get<0>(x) == std::get<0>(y) && std::get<1>(x) == std::get<1>(y);
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool common = (i > 0 && same_ends(edges[i - 1], edges[i])) ||
                        (i + 1 < edges.size() && same_ends(edges[i], edges[i + 1]));
    if (!common) continue;
    if (middles.of_side.empty()) middles.of_side.assign(boundary.sides(), kNone);
    const std::uint32_t s = std::get<2>(edges[i]);
    if (middles.of_side[s] != kNone) continue;
    const auto middle = static_cast<std::uint32_t>(middles.count++);
    middles.of_side[s] = middles.of_side[corners.mate[s]] = middle;
  }
}

std::vector<std::uint32_t> conflicting_regions(
    std::span<const std::array<std::uint32_t, 3>> triangles,
    std::span<const std::uint32_t> region_of_triangle) {
  std::vector<Passage> passages;
  passages.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k];
      const std::uint32_t b = triangles[t][(k + 1) % 3];
      passages.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  const auto ends = [](const Passage& p) { return std::tuple(p.low, p.high); };
  std::sort(passages.begin(), passages.end(),
            [&](const Passage& x, const Passage& y) { return ends(x) < ends(y); });
  std::vector<std::uint32_t> regions;
  for (std::size_t first = 0; first < passages.size();) {
    std::size_t last = first + 1;
    while (last < passages.size() && ends(passages[last]) == ends(passages[first])) ++last;
    const bool sound = last - first == 2 && passages[first].upward != passages[first + 1].upward &&
                       passages[first].low != passages[first].high;
    for (; first < last; ++first) {
      if (!sound) regions.push_back(region_of_triangle[passages[first].triangle]);
    }
  }
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  return regions;
}

}  // namespace meshrepair::internal
