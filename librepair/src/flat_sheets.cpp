#include "flat_sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <bsp/disjoint_sets.h>
#include <bsp/topology.h>
#include <repair/orient_parts.h>

#include "number_spacing.h"

namespace meshrepair::internal {
namespace {

// Three points tell the plane, each of which may be off: another one may seem so much farther off.
constexpr double kSeenOff = 4;

Vec3d on_grid(const Grid& grid, const Vec3d& p) { return (p - grid.origin) / grid.unit; }

std::size_t farthest(const std::vector<Vec3d>& points, const auto& distance) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double d = distance(points[i]);
    if (d <= most) continue;
    most = d;
    best = i;
  }
  return best;
}

// Whether all points lie in one plane, each off by no more than `rounding`: the plane of three that
// are far from each other tells.
bool is_flat(const std::vector<Vec3d>& points, double rounding) {
  const auto from = [](const Vec3d& p) {
    return [&p](const Vec3d& q) { return (q - p).squaredNorm(); };
  };
  const Vec3d first = points[farthest(points, from(points[0]))];
  const Vec3d second = points[farthest(points, from(first))];
  const Vec3d along = (second - first).normalized();
  const auto from_line = [&](const Vec3d& q) { return (q - first).cross(along).squaredNorm(); };
  const Vec3d third = points[farthest(points, from_line)];
  const Vec3d normal = along.cross(third - first).normalized();
  return std::all_of(points.begin(), points.end(), [&](const Vec3d& p) {
    return std::abs((p - first).dot(normal)) <= kSeenOff * rounding;
  });
}

std::vector<Vec3d> corners_on_grid(const CleanSoup& soup) {
  std::vector<Vec3d> points;
  points.reserve(soup.points.size());
  for (const Vec3d& p : soup.points) points.push_back(on_grid(soup.grid, p));
  return points;
}

using RegionTriangle = std::pair<std::uint32_t, std::uint32_t>;

// The regions of solid cells that are connected through facets, by the lowest of their cells.
DisjointSets solid_regions(const CellComplex& complex, const std::vector<char>& solid) {
  DisjointSets regions(solid.size());
  for (const Facet& f : complex.facets) {
    if (!f.above.valid() || !f.below.valid()) continue;
    if (solid[f.above.index()] != 0 && solid[f.below.index()] != 0) {
      regions.join(f.above.value, f.below.value);
    }
  }
  return regions;
}

// What triangles bound which region, sorted, each pair once.
std::vector<RegionTriangle> walls_of(const CoveredCells& covered, const std::vector<char>& solid,
                                     DisjointSets& regions) {
  const auto is_solid = [&](CellId c) { return c.valid() && solid[c.index()] != 0; };
  std::vector<RegionTriangle> walls;
  for (FacetId f(0u); f < covered.complex.facets.end_id(); ++f.value) {
    const Facet& facet = covered.complex.facets[f];
    if (!covered.cover[f].opaque() || is_solid(facet.above) == is_solid(facet.below)) continue;
    const CellId inside = is_solid(facet.above) ? facet.above : facet.below;
    walls.emplace_back(regions.root(inside.value), covered.cover[f].triangle.value);
  }
  std::sort(walls.begin(), walls.end());
  walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
  return walls;
}

// Of each cell, whether it stands for a region that is flat.
std::vector<char> find_flat_regions(const CleanSoup& soup, const std::vector<char>& open,
                                    const std::vector<RegionTriangle>& walls, std::size_t cells) {
  const double rounding = rounding_of(soup);
  std::vector<char> flat(cells, 0);
  std::vector<Vec3d> corners;
  for (std::size_t i = 0; i < walls.size();) {
    const std::uint32_t region = walls[i].first;
    bool is_open = true;
    corners.clear();
    for (; i < walls.size() && walls[i].first == region; ++i) {
      is_open = is_open && open[walls[i].second] != 0;
      if (!is_open) continue;
      for (const PointId p : soup.triangles[TriangleId(walls[i].second)].corners) {
        corners.push_back(on_grid(soup.grid, soup.points[p]));
      }
    }
    flat[region] = is_open && is_flat(corners, rounding) ? 1 : 0;
  }
  return flat;
}

}  // namespace

std::vector<char> triangles_of_open_parts(const CleanSoup& soup) {
  TopologyPlaces places;
  const Topology topology = examine_topology(index_triangles(soup), soup.points.size(), &places);
  std::vector<char> is_open(topology.parts, 0);
  for (const std::uint32_t side : places.open_sides) is_open[places.parts[side / 3]] = 1;
  std::vector<char> open;
  open.reserve(places.parts.size());
  for (const std::uint32_t part : places.parts) open.push_back(is_open[part]);
  return open;
}

double rounding_of(const CleanSoup& soup) {
  bool is_single = true;
  double most = 0;
  for (const Vec3d& p : soup.points) {
    is_single = is_single && rounded_to(p, Precision::float32) == p;
    most = std::max(most, p.cwiseAbs().maxCoeff());
  }
  const double spacing = is_single ? number_spacing(most, Precision::float32) / soup.grid.unit : 0;
  return 0.5 * std::numbers::sqrt3 * std::max(1.0, spacing);
}

bool is_flat_sheet(const CleanSoup& soup) {
  if (!is_flat(corners_on_grid(soup), rounding_of(soup))) return false;
  return examine_topology(index_triangles(soup), soup.points.size()).open_edges > 0;
}

std::size_t empty_flat_regions(const CoveredCells& covered, std::vector<char>& solid) {
  const CleanSoup& soup = covered.complex.soup();
  const std::vector<char> open = triangles_of_open_parts(soup);
  if (std::count(open.begin(), open.end(), 1) == 0) return 0;
  DisjointSets regions = solid_regions(covered.complex, solid);
  const std::vector<RegionTriangle> walls = walls_of(covered, solid, regions);
  const std::vector<char> flat = find_flat_regions(soup, open, walls, solid.size());
  for (std::uint32_t c = 0; c < solid.size(); ++c) {
    if (solid[c] != 0 && flat[regions.root(c)] != 0) solid[c] = 0;
  }
  return static_cast<std::size_t>(std::count(flat.begin(), flat.end(), 1));
}

}  // namespace meshrepair::internal
