// SPDX-License-Identifier: MIT
#include "page/drawn_mesh.h"

#include <algorithm>
#include <utility>

#include <mesh/cluster_points.h>

namespace meshrepair {
namespace {

std::vector<std::uint32_t> every_so_many(const std::vector<std::uint32_t>& from, std::size_t most) {
  std::vector<std::uint32_t> some;
  some.reserve(most);
  for (std::size_t i = 0; i < most; ++i) some.push_back(from[i * from.size() / most]);
  return some;
}

ClusteredSoup simplified(const TriangleSoup& soup, std::vector<std::uint32_t> marked,
                         std::size_t most) {
  if (marked.size() > most) marked = every_so_many(marked, most);
  std::vector<char> fixed(soup.triangles.size(), 0);
  for (const std::uint32_t t : marked) fixed[t] = 1;
  return cluster_points(soup, fixed, most - marked.size());
}

template <class Value>
std::vector<Value> taken(std::span<const Value> values, const std::vector<std::uint32_t>& source) {
  std::vector<Value> some;
  if (values.empty()) return some;
  some.reserve(source.size());
  for (const std::uint32_t t : source) some.push_back(values[t]);
  return some;
}

}  // namespace

bool is_finite(const TriangleSoup& soup, std::uint32_t triangle) {
  const auto& corners = soup.triangles[triangle];
  return std::all_of(corners.begin(), corners.end(),
                     [&](std::uint32_t p) { return soup.points[p].allFinite(); });
}

DrawnMesh drawn_mesh(const TriangleSoup& soup, std::span<const std::uint32_t> kinds,
                     std::span<const std::uint16_t> marks, std::size_t most) {
  std::vector<std::uint32_t> marked;
  std::size_t finite = 0;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    if (!is_finite(soup, t)) continue;
    ++finite;
    if (!marks.empty() && marks[t] != 0) marked.push_back(t);
  }
  ClusteredSoup drawn = simplified(soup, std::move(marked), std::min(most, finite));
  DrawnMesh mesh;
  mesh.is_simplified = finite > most;
  mesh.soup = std::move(drawn.soup);
  mesh.kinds = taken(kinds, drawn.source);
  mesh.marks = taken(marks, drawn.source);
  mesh.source = std::move(drawn.source);
  return mesh;
}

}  // namespace meshrepair
