// SPDX-License-Identifier: MIT
#include "region_triangulator.h"

#include <algorithm>
#include <utility>

#include <base/assert.h>
#include <exact/predicates.h>

#include "loose_regions.h"

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
// A polygon is split into two chains that are joined by a zigzag of diagonals. When one straight
// side carries vertices, that side is one chain and everything else the other: a vertex inside the
// side is in line with no other side, so no triangle with a corner there and one elsewhere is
// degenerate.
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

// Triangulating a region: its facets are convex, so each is triangulated easily and exactly; then
// the vertices that are not kept are taken out one by one.

RegionTriangulator::RegionTriangulator(const CellComplex& complex, const std::vector<char>& solid,
                                       const Boundary& boundary, const ManifoldCorners& corners,
                                       const MergedFacets& merged)
    : complex_(complex),
      solid_(solid),
      boundary_(boundary),
      corners_(corners),
      merged_(merged),
      sectors_(boundary.sides()),
      local_(boundary.sides(), kNone),
      slot_of_side_(boundary.sides(), kNone),
      mesh_(complex.planes, complex.loose) {
  for (std::uint32_t s = 0; s < boundary.sides(); ++s) {
    if (merged.dissolved[s] != 0) sectors_.join(s, boundary.next(corners.mate[s]));
  }
}

bool RegionTriangulator::run(std::size_t region, std::vector<RegionTriangle>& triangles) {
  triangles.clear();
  const bool done = try_region(region, triangles);
  MESHREPAIR_ASSERT(done || complex_.loose);
  return done;
}

bool RegionTriangulator::try_region(std::size_t region, std::vector<RegionTriangle>& triangles) {
  if (merged_.kept_corners[region] == 3) return trace_triangle(region, triangles);
  if (!fill_mesh(region) || !remove_vertices()) return false;
  mesh_.improve();
  mesh_.for_each_triangle([&](const auto& corners, const auto& marks) {
    triangles.push_back({{vertex_[corners[0]], vertex_[corners[1]], vertex_[corners[2]]}, marks});
  });
  return true;
}

// A region whose outline has three corners is a triangle.
bool RegionTriangulator::trace_triangle(std::size_t region,
                                        std::vector<RegionTriangle>& triangles) {
  std::uint32_t start = kNone;
  for (const std::uint32_t p : merged_.polygons_of(region)) {
    for (std::uint32_t s = boundary_.first[p]; s < boundary_.first[p + 1] && start == kNone; ++s) {
      if (merged_.dissolved[s] == 0 && merged_.kept[corners_.vertex[s]] != 0) start = s;
    }
    if (start != kNone) break;
  }
  if (start == kNone) return false;
  const auto next = [this](std::uint32_t s) {
    return merged_.next_on_outline(boundary_, corners_, s);
  };
  RegionTriangle triangle{};
  std::uint32_t s = start;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k > 0 && s == start) return false;
    triangle.vertices[k] = corners_.vertex[s];
    triangle.sides[k] = s;
    s = next(s);
    if (merged_.kept[corners_.vertex[s]] == 0) triangle.sides[k] = kNone;
    while (merged_.kept[corners_.vertex[s]] == 0) s = next(s);
  }
  if (s != start) return false;
  triangles.push_back(triangle);
  return true;
}

bool RegionTriangulator::fill_mesh(std::size_t region) {
  const auto polygons = merged_.polygons_of(region);
  const Facet& facet = complex_.facets[boundary_.facet[polygons[0]]];
  const bool solid_below = facet.below.valid() && solid_[facet.below.index()] != 0;
  mesh_.reset(facet.plane, solid_below ? 1 : -1);
  vertex_.clear();
  bool filled = true;
  for (const std::uint32_t p : polygons) filled = filled && add_polygon(p);
  if (filled) join_polygons(region);
  // Clean for the next region, whatever became of this one.
  for (const std::uint32_t p : polygons) {
    for (std::uint32_t s = boundary_.first[p]; s < boundary_.first[p + 1]; ++s) {
      local_[sectors_.root(s)] = kNone;
    }
  }
  return filled;
}

void RegionTriangulator::join_polygons(std::size_t region) {
  for (const std::uint32_t p : merged_.polygons_of(region)) {
    for (std::uint32_t s = boundary_.first[p]; s < boundary_.first[p + 1]; ++s) {
      if (merged_.dissolved[s] != 0) {
        mesh_.join(slot_of_side_[s], slot_of_side_[corners_.mate[s]]);
      } else {
        mesh_.mark(slot_of_side_[s], s);
      }
    }
  }
}

bool RegionTriangulator::add_polygon(std::uint32_t polygon) {
  const std::uint32_t first = boundary_.first[polygon];
  const std::uint32_t n = boundary_.first[polygon + 1] - first;
  polygon_corners_.clear();
  for (std::uint32_t s = first; s < first + n; ++s) {
    std::uint32_t& local = local_[sectors_.root(s)];
    if (local == kNone) {
      local = mesh_.add_vertex(point_of(s));
      vertex_.push_back(corners_.vertex[s]);
    }
    polygon_corners_.push_back({point_of(s).position, is_straight(s)});
  }
  const auto bent = std::count_if(polygon_corners_.begin(), polygon_corners_.end(),
                                  [](const PolygonCorner& c) { return !c.straight; });
  // In a loose complex a facet may be thinner than the tolerance. Then any triangles will do.
  if (bent < 3) {
    if (polygon_corners_.size() < 3) return false;
    for (PolygonCorner& corner : polygon_corners_) corner.straight = false;
  }
  pieces_.clear();
  triangulate_convex(polygon_corners_, pieces_);
  diagonals_.clear();
  for (const auto& piece : pieces_) {
    const std::uint32_t t = mesh_.add_triangle({local_[sectors_.root(first + piece[0])],
                                                local_[sectors_.root(first + piece[1])],
                                                local_[sectors_.root(first + piece[2])]});
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = piece[k];
      const std::uint32_t b = piece[(k + 1) % 3];
      const auto slot = 3 * t + static_cast<std::uint32_t>(k);
      if (b == (a + 1 < n ? a + 1 : 0)) {
        slot_of_side_[first + a] = slot;
      } else {
        diagonals_.push_back({std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), slot});
      }
    }
  }
  std::sort(diagonals_.begin(), diagonals_.end(),
            [](const Diagonal& a, const Diagonal& b) { return a.ends < b.ends; });
  for (std::size_t i = 0; i + 1 < diagonals_.size(); i += 2) {
    mesh_.join(diagonals_[i].slot, diagonals_[i + 1].slot);
  }
  return true;
}

bool RegionTriangulator::remove_vertices() {
  for (std::uint32_t v = 0; v < vertex_.size(); ++v) {
    if (merged_.kept[vertex_[v]] == 0 && !mesh_.remove_vertex(v)) return false;
  }
  return true;
}

const Point& RegionTriangulator::point_of(std::uint32_t side) const {
  return complex_.vertices[corner_vertex(complex_, boundary_, side, solid_)];
}

// Whether the corner at the start of a side lies on the straight line from its neighbours.
bool RegionTriangulator::is_straight(std::uint32_t s) const {
  if (complex_.loose) {
    return lies_between(point_of(s), point_of(boundary_.previous(s)), point_of(boundary_.next(s)));
  }
  const PlaneId line = complex_.side_plane(complex_.uses[boundary_.use[boundary_.previous(s)]]);
  return side(point_of(boundary_.next(s)), line, complex_.planes) == 0;
}

}  // namespace meshrepair::internal
