// SPDX-License-Identifier: MIT
#include "edge_fan.h"

#include <algorithm>
#include <vector>

#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

// A triangle at the edge. Where it lies seen from the first triangle: 0 in the same half plane, 1
// before half a turn, 2 at half a turn, 3 after it.
struct Wing {
  std::uint32_t side;
  GridPoint tip;
  Plane plane;
  int quarter;
};

// Of two parallel normals.
bool same_direction(const Plane& a, const Plane& b) {
  Int128 dot = 0;
  for (std::size_t k = 0; k < 3; ++k) dot += Int128{a.normal[k]} * b.normal[k];
  return dot > 0;
}

int quarter_of(const Wing& wing, const Plane& first) {
  const int s = side(wing.tip, first);
  if (s != 0) return s > 0 ? 1 : 3;
  return same_direction(wing.plane, first) ? 0 : 2;
}

bool comes_first(const Wing& a, const Wing& b) {
  if (a.quarter != b.quarter) return a.quarter < b.quarter;
  return a.quarter % 2 == 1 && side(b.tip, a.plane) > 0;
}

}  // namespace

bool sort_around_edge(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                      std::span<std::uint32_t> sides) {
  std::vector<Wing> wings;
  wings.reserve(sides.size());
  const auto point = [&](std::uint32_t p) { return soup.grid_points[PointId(p)]; };
  const std::uint32_t u = side_start(triangles, sides[0]);
  const std::uint32_t v = side_start(triangles, next_side(sides[0]));
  for (const std::uint32_t s : sides) {
    const GridPoint tip = point(side_start(triangles, next_side(next_side(s))));
    wings.push_back({s, tip, plane_through(point(u), point(v), tip), 0});
  }
  const Plane first = wings[0].plane;
  for (Wing& wing : wings) wing.quarter = quarter_of(wing, first);
  std::sort(wings.begin(), wings.end(), comes_first);
  for (std::size_t i = 0; i < wings.size(); ++i) {
    if (i > 0 && !comes_first(wings[i - 1], wings[i])) return false;
    sides[i] = wings[i].side;
  }
  return true;
}

}  // namespace meshrepair::internal
