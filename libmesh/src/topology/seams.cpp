// SPDX-License-Identifier: MIT
#include <cstring>
#include <span>

#include <mesh/edge_table.h>
#include <mesh/seams.h>

namespace meshrepair {
namespace {

// Of the corner of the side's triangle at this point, which is one of the side's ends.
std::uint32_t value_at(const TriangleSoup& soup, const CornerAttribute& attribute,
                       std::uint32_t side, std::uint32_t point) {
  const bool at_start = side_start(soup.triangles, side) == point;
  return attribute.of_corner[at_start ? side : next_side(side)];
}

bool same_value(const CornerAttribute& attribute, std::uint32_t a, std::uint32_t b) {
  if (a == b || a == kNone || b == kNone) return a == b;
  const std::size_t n = attribute.components;
  const double* const values = attribute.values.data();
  return std::memcmp(values + n * a, values + n * b, n * sizeof(double)) == 0;
}

}  // namespace

std::size_t count_seams(const TriangleSoup& soup, const CornerAttribute& attribute) {
  std::size_t seams = 0;
  EdgeTable(soup.triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() != 2) return;
    const std::uint32_t start = side_start(soup.triangles, sides[0]);
    const std::uint32_t end = side_start(soup.triangles, next_side(sides[0]));
    for (const std::uint32_t point : {start, end}) {
      if (same_value(attribute, value_at(soup, attribute, sides[0], point),
                     value_at(soup, attribute, sides[1], point))) {
        continue;
      }
      ++seams;
      return;
    }
  });
  return seams;
}

}  // namespace meshrepair
