// A polygon is split into two chains that are joined by a zigzag of diagonals. When one straight
// side carries vertices, that side is one chain and everything else the other: a vertex inside the
// side is in line with no other side, so no triangle with a corner there and one elsewhere is
// degenerate.
#include "triangulate_convex.h"

#include <base/assert.h>

namespace meshrepair::internal {
namespace {

using Polygon = std::span<const PolygonCorner>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

double squared_distance(const PolygonCorner& a, const PolygonCorner& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = a.position[axis] - b.position[axis];
    sum += d * d;
  }
  return sum;
}

struct Side {
  std::size_t begin = 0;     // a corner that is not straight
  std::size_t straight = 0;  // how many straight ones follow it
};

Side fullest_side(Polygon polygon) {
  const std::size_t n = polygon.size();
  Side best;
  for (std::size_t i = 0; i < n; ++i) {
    if (polygon[i].straight) continue;
    std::size_t straight = 0;
    while (polygon[(i + 1 + straight) % n].straight) ++straight;
    if (straight > best.straight || (straight == 0 && best.straight == 0)) best = {i, straight};
  }
  return best;
}

// No straight vertices: any diagonal will do.
void zigzag(Polygon polygon, Triangles& triangles) {
  auto low = std::uint32_t{0};
  auto high = static_cast<std::uint32_t>(polygon.size() - 1);
  while (high - low >= 2) {
    if (squared_distance(polygon[low + 1], polygon[high]) <=
        squared_distance(polygon[low], polygon[high - 1])) {
      triangles.push_back({low, low + 1, high});
      ++low;
    } else {
      triangles.push_back({low, high - 1, high});
      --high;
    }
  }
}

// Chain s: the side from s(0) to s(m). Chain t: from the same corner t(0) = s(0) the other way
// round to t(k) = s(m).
void join_side(Polygon polygon, const Side& side, Triangles& triangles) {
  const std::size_t n = polygon.size();
  const std::size_t m = side.straight + 1;
  const std::size_t k = n - m;
  MESHREPAIR_ASSERT(m >= 2 && k >= 2);
  const auto s = [&](std::size_t i) { return static_cast<std::uint32_t>((side.begin + i) % n); };
  const auto t = [&](std::size_t j) {
    return static_cast<std::uint32_t>((side.begin + n - j) % n);
  };
  triangles.push_back({s(0), s(1), t(1)});
  std::size_t i = 1;
  std::size_t j = 1;
  while (i < m - 1 || j < k - 1) {
    const bool along_side =
        j == k - 1 || (i < m - 1 && squared_distance(polygon[s(i + 1)], polygon[t(j)]) <=
                                        squared_distance(polygon[s(i)], polygon[t(j + 1)]));
    if (along_side) {
      triangles.push_back({s(i), s(i + 1), t(j)});
      ++i;
    } else {
      triangles.push_back({s(i), t(j + 1), t(j)});
      ++j;
    }
  }
  triangles.push_back({s(m - 1), s(m), t(k - 1)});
}

}  // namespace

void triangulate_convex(Polygon polygon, Triangles& triangles) {
  MESHREPAIR_ASSERT(polygon.size() >= 3);
  const Side side = fullest_side(polygon);
  if (side.straight == 0) {
    zigzag(polygon, triangles);
  } else {
    join_side(polygon, side, triangles);
  }
}

}  // namespace meshrepair::internal
