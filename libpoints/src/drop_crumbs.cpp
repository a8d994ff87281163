// SPDX-License-Identifier: MIT
#include "drop_crumbs.h"

#include <algorithm>
#include <span>

#include <base/disjoint_sets.h>
#include <mesh/edge_table.h>

namespace meshrepair {

namespace {

// Open parts of fewer triangles, as a share of the largest part, are looked at twice: where their
// corners disagree, and where their triangles are large.
constexpr double kSmall = 0.1;
constexpr double kTiny = 0.02;

// Of triangles between scattered points about so many at the most are wanted by all corners; on a
// surface nearly all, with noise of a quarter of the spacing half of them.
constexpr double kScattered = 0.45;

struct Part {
  std::size_t triangles = 0;
  std::size_t agreed = 0;  // of these, by all three corners
  double sizes = 0;        // their sum
  bool open = false;

  void add(const VotedTriangle& triangle) {
    ++triangles;
    agreed += triangle.votes == 3;
    sizes += static_cast<double>(triangle.size);
  }
  [[nodiscard]] double mean_size() const { return sizes / static_cast<double>(triangles); }
  [[nodiscard]] bool is_less_than(double share, const Part& other) const {
    return static_cast<double>(triangles) < share * static_cast<double>(other.triangles);
  }

  [[nodiscard]] bool is_scattered() const {
    return static_cast<double>(agreed) < kScattered * static_cast<double>(triangles);
  }
};

}  // namespace

std::size_t drop_crumbs(std::vector<VotedTriangle>& triangles, std::size_t fewest, double coarse) {
  if (triangles.empty()) return 0;
  std::vector<IndexTriangle> corners;
  corners.reserve(triangles.size());
  for (const VotedTriangle& triangle : triangles) corners.push_back(triangle.corners);
  DisjointSets parts(triangles.size());
  std::vector<std::uint32_t> rim;  // a triangle of each open edge
  EdgeTable(corners).for_each_edge([&](std::span<const std::uint32_t> sides) {
    for (const std::uint32_t side : sides) parts.join(sides[0] / 3, side / 3);
    if (sides.size() == 1) rim.push_back(sides[0] / 3);
  });
  std::vector<Part> part_of_root(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    part_of_root[parts.root(t)].add(triangles[t]);
  }
  for (const std::uint32_t t : rim) part_of_root[parts.root(t)].open = true;
  const Part largest =
      *std::max_element(part_of_root.begin(), part_of_root.end(),
                        [](const Part& a, const Part& b) { return a.triangles < b.triangles; });
  const auto is_crumb = [&](const Part& part) {
    if (!part.open) return false;
    return part.triangles < fewest || (part.is_less_than(kSmall, largest) && part.is_scattered()) ||
           (coarse > 0 && part.is_less_than(kTiny, largest) &&
            part.mean_size() > coarse * largest.mean_size());
  };
  std::size_t kept = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (!is_crumb(part_of_root[parts.root(t)])) triangles[kept++] = triangles[t];
  }
  const std::size_t dropped = triangles.size() - kept;
  triangles.resize(kept);
  return dropped;
}

}  // namespace meshrepair
