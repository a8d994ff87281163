// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <mesh/topology.h>
#include <mesh/weld_points.h>
#include <repair/join_gaps.h>

namespace meshrepair {
namespace {

// Of each triangle, whether the body that it is of has an open edge.
std::vector<char> find_open(const TriangleSoup& soup) {
  const std::vector<std::uint32_t> place = first_in_place(soup.points);
  std::vector<IndexTriangle> triangles;
  triangles.reserve(soup.triangles.size());
  for (const auto& t : soup.triangles) triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return triangles_of_open_parts(triangles, soup.points.size());
}

struct Copy {
  IndexTriangle corners;  // ascending
  bool is_turned;
  std::uint32_t triangle;
};

Copy copy_of(const TriangleSoup& soup, std::uint32_t t) {
  Copy copy{soup.triangles[t], false, t};
  auto& c = copy.corners;
  using TwoCorners = std::pair<std::size_t, std::size_t>;
  for (const auto& [i, k] : {TwoCorners{0, 1}, TwoCorners{1, 2}, TwoCorners{0, 1}}) {
    if (c[i] <= c[k]) continue;
    std::swap(c[i], c[k]);
    copy.is_turned = !copy.is_turned;
  }
  return copy;
}

}  // namespace

void drop_facing_copies(const TriangleSoup& given, JoinedSoup& joined) {
  const std::vector<char> is_open = find_open(given);
  std::vector<Copy> copies;
  for (std::uint32_t t = 0; t < joined.source.size(); ++t) {
    if (is_open[joined.source[t]] == 0) copies.push_back(copy_of(joined.soup, t));
  }
  std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) {
    return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle);
  });
  std::vector<char> is_dropped(joined.source.size(), 0);
  for (std::size_t first = 0, last = 0; first < copies.size(); first = last) {
    std::array<std::vector<std::uint32_t>, 2> facing;
    for (; last < copies.size() && copies[last].corners == copies[first].corners; ++last) {
      facing[copies[last].is_turned ? 1 : 0].push_back(copies[last].triangle);
    }
    const std::size_t pairs = std::min(facing[0].size(), facing[1].size());
    for (const std::vector<std::uint32_t>& triangles : facing) {
      for (std::size_t i = 0; i < pairs; ++i) is_dropped[triangles[i]] = 1;
    }
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < is_dropped.size(); ++t) {
    if (is_dropped[t] != 0) continue;
    joined.soup.triangles[kept] = joined.soup.triangles[t];
    joined.source[kept++] = joined.source[t];
  }
  joined.soup.triangles.resize(kept);
  joined.source.resize(kept);
}

}  // namespace meshrepair
