// SPDX-License-Identifier: MIT
#include "open_sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <base/parallel.h>
#include <mesh/precision.h>
#include <mesh/topology.h>
#include <repair/orient_parts.h>

namespace meshrepair::internal {
namespace {

// Of the area of the triangles around a region, what may be uncovered: as of a hole in a plane.
constexpr double kMostUncovered = 0.95;

// Of the area of an open part, what has to bound something solid for that to be what was meant.
constexpr double kLeastBounding = 0.1;

using RegionTriangle = std::pair<std::uint32_t, std::uint32_t>;

// Regions are connected through uncovered links: what is walled in has nothing to do with what is
// solid beside it. The lowest of its cells stands for a region.
class OpenRegions {
 public:
  OpenRegions(const CellGraph& graph, const CleanSoup& soup, std::vector<char>& solid)
      : graph_(graph),
        soup_(soup),
        solid_(solid),
        topology_(examine_topology(index_triangles(soup), soup.points.size(), &places_)),
        open_(topology_.parts, 0),
        regions_(solid.size()) {
    for (const std::uint32_t side : places_.open_sides) open_[places_.parts[side / 3]] = 1;
  }

  std::size_t run() {
    if (places_.open_sides.empty()) return 0;
    find_regions();
    find_walls();
    const std::size_t open =
        empty([&](std::size_t first, std::size_t last) { return is_open(first, last); });
    const std::vector<char> crumbles = parts_that_bound_little();
    return open + empty([&](std::size_t first, std::size_t last) {
             return all_are(crumbles, first, last);
           });
  }

 private:
  [[nodiscard]] bool is_solid(CellId c) const { return solid_[c.index()] != 0; }
  [[nodiscard]] bool bounds(const Link& link) const {
    return is_solid(link.below) != is_solid(link.above);
  }
  [[nodiscard]] std::uint32_t part_of(std::uint32_t triangle) const {
    return places_.parts[triangle];
  }

  void find_regions() {
    for (const Link& link : graph_.links()) {
      if (!link.opaque() && is_solid(link.below) && is_solid(link.above)) {
        regions_.join(link.above.value, link.below.value);
      }
    }
  }

  // Which triangles bound which region, sorted, each pair once, and the areas of both kinds.
  void find_walls() {
    covered_area_.resize(solid_.size());
    uncovered_area_.resize(solid_.size());
    for (const Link& link : graph_.links()) {
      if (!link.opaque() && !bounds(link)) continue;
      for (const CellId cell : {link.above, link.below}) {
        if (!is_solid(cell)) continue;
        const std::uint32_t region = regions_.root(cell.value);
        (link.opaque() ? covered_area_ : uncovered_area_)[region] += link.area;
        if (link.opaque()) walls_.emplace_back(region, link.triangle.value);
      }
    }
    std::sort(walls_.begin(), walls_.end());
    walls_.erase(std::unique(walls_.begin(), walls_.end()), walls_.end());
  }

  // The regions whose walls, a range of them, are so; says how many.
  std::size_t empty(auto are_so) {
    std::vector<char> chosen(solid_.size(), 0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < walls_.size();) {
      const std::size_t first = i;
      const std::uint32_t region = walls_[first].first;
      while (i < walls_.size() && walls_[i].first == region) ++i;
      if (solid_[region] == 0 || !are_so(first, i)) continue;
      chosen[region] = 1;
      ++count;
    }
    for (std::uint32_t c = 0; c < solid_.size(); ++c) {
      if (solid_[c] != 0 && chosen[regions_.root(c)] != 0) solid_[c] = 0;
    }
    return count;
  }

  // The open parts of which hardly anything bounds what is solid.
  [[nodiscard]] std::vector<char> parts_that_bound_little() const {
    std::vector<double> area(topology_.parts, 0), bounding(topology_.parts, 0);
    for (const Link& link : graph_.links()) {
      if (!link.opaque()) continue;
      const std::uint32_t part = part_of(link.triangle.value);
      area[part] += link.area;
      if (bounds(link)) bounding[part] += link.area;
    }
    std::vector<char> little;
    for (std::size_t p = 0; p < area.size(); ++p) {
      little.push_back(open_[p] != 0 && bounding[p] < kLeastBounding * area[p] ? 1 : 0);
    }
    return little;
  }

  // Whether all walls of a range are of such parts.
  [[nodiscard]] bool all_are(const std::vector<char>& parts, std::size_t first,
                             std::size_t last) const {
    for (std::size_t i = first; i < last; ++i) {
      if (parts[part_of(walls_[i].second)] == 0) return false;
    }
    return true;
  }

  [[nodiscard]] bool is_open(std::size_t first, std::size_t last) {
    if (!all_are(open_, first, last)) return false;
    const std::uint32_t region = walls_[first].first;
    if (uncovered_area_[region] > kMostUncovered * covered_area_[region]) return true;
    corners_.clear();
    for (std::size_t i = first; i < last; ++i) {
      for (const PointId p : soup_.triangles[TriangleId(walls_[i].second)].corners) {
        corners_.push_back(original_place(soup_, p));
      }
    }
    return is_flat(corners_, rounding_);
  }

  const CellGraph& graph_;
  const CleanSoup& soup_;
  std::vector<char>& solid_;
  TopologyPlaces places_;
  const Topology topology_;
  std::vector<char> open_;  // of each part
  const double rounding_ = rounding_of(soup_);
  DisjointSets regions_;
  std::vector<RegionTriangle> walls_;
  std::vector<double> covered_area_, uncovered_area_;
  std::vector<Vec3d> corners_;
};

}  // namespace

std::size_t empty_open_regions(const CellGraph& graph, const CleanSoup& soup,
                               std::vector<char>& solid) {
  return OpenRegions(graph, soup, solid).run();
}

namespace {

// Three points tell the plane, each of which may be off: another one may seem so much farther off.
constexpr double kSeenOff = 4;

constexpr std::size_t kPointsPerTask = 32768;

// Where a number is the largest: of several the first.
struct Largest {
  double value = -1;
  std::size_t at = 0;
};

// The point i below `count`, as `at` tells it, that is farthest away.
template <class At, class Distance>
Vec3d farthest(std::size_t count, const At& at, const Distance& distance) {
  const auto find = [&](std::size_t first, std::size_t last) {
    Largest largest;
    for (std::size_t i = first; i < last; ++i) {
      const double value = distance(at(i));
      if (value > largest.value) largest = {value, i};
    }
    return largest;
  };
  const Largest largest =
      parallel_reduce(count, kPointsPerTask, find, [](Largest& all, const Largest& some) {
        if (some.value > all.value) all = some;
      });
  return at(largest.at);
}

template <class At>
Vec3d farthest_from(const Vec3d& p, std::size_t count, const At& at) {
  return farthest(count, at, [&](const Vec3d& q) { return (q - p).squaredNorm(); });
}

// Whether all points lie in one plane, as is_flat() has it.
template <class At>
bool are_flat(std::size_t count, const At& at, double rounding) {
  const Vec3d first = farthest_from(at(0), count, at);
  const Vec3d along = (farthest_from(first, count, at) - first).normalized();
  const Vec3d beside =
      farthest(count, at, [&](const Vec3d& p) { return (p - first).cross(along).squaredNorm(); });
  const Vec3d normal = along.cross(beside - first).normalized();
  for (std::size_t i = 0; i < count; ++i) {
    if (!(std::abs((at(i) - first).dot(normal)) <= kSeenOff * rounding)) return false;
  }
  return true;
}

// What points tell of the numbers that they were given in.
struct Numbers {
  bool are_single = true;
  double most = 0;
};

}  // namespace

double rounding_of(const CleanSoup& soup) {
  const auto look_at = [&](std::size_t first, std::size_t last) {
    Numbers numbers;
    for (std::size_t i = first; i < last; ++i) {
      const Vec3d& p = soup.points[PointId(i)];
      numbers.are_single = numbers.are_single && rounded_to(p, Precision::float32) == p;
      numbers.most = std::max(numbers.most, p.cwiseAbs().maxCoeff());
    }
    return numbers;
  };
  const Numbers numbers = parallel_reduce(soup.points.size(), kPointsPerTask, look_at,
                                          [](Numbers& all, const Numbers& some) {
                                            all.are_single = all.are_single && some.are_single;
                                            all.most = std::max(all.most, some.most);
                                          });
  const double spacing =
      numbers.are_single ? number_spacing(numbers.most, Precision::float32) / soup.grid.unit : 0;
  return 0.5 * std::numbers::sqrt3 * std::max(1.0, spacing);
}

Vec3d original_place(const CleanSoup& soup, PointId point) {
  return (soup.points[point] - soup.grid.origin) / soup.grid.unit;
}

bool is_flat(const std::vector<Vec3d>& points, double rounding) {
  return are_flat(
      points.size(), [&](std::size_t i) { return points[i]; }, rounding);
}

bool is_flat_sheet(const CleanSoup& soup) {
  const auto is_given = [](const Triangle& t) { return t.source != Triangle::kNoSource; };
  const auto given = static_cast<std::size_t>(
      std::find_if_not(soup.triangles.begin(), soup.triangles.end(), is_given) -
      soup.triangles.begin());
  const auto corner = [&](std::size_t i) {
    return original_place(soup, soup.triangles[TriangleId(i / 3)].corners[i % 3]);
  };
  if (!are_flat(3 * given, corner, rounding_of(soup))) return false;
  std::vector<IndexTriangle> triangles = index_triangles(soup);
  triangles.resize(given);
  const std::vector<char> open = triangles_of_open_parts(triangles, soup.points.size());
  return std::all_of(open.begin(), open.end(), [](char x) { return x != 0; });
}

std::vector<char> triangles_of_flat_parts(const CleanSoup& soup) {
  TopologyPlaces places;
  const std::size_t parts =
      examine_topology(index_triangles(soup), soup.points.size(), &places).parts;
  std::vector<std::vector<Vec3d>> corners(parts);
  for (std::size_t t = 0; t < places.parts.size(); ++t) {
    for (const PointId p : soup.triangles[TriangleId(t)].corners) {
      corners[places.parts[t]].push_back(original_place(soup, p));
    }
  }
  const double rounding = rounding_of(soup);
  std::vector<char> flat;
  flat.reserve(parts);
  for (const std::vector<Vec3d>& part : corners) flat.push_back(is_flat(part, rounding) ? 1 : 0);
  std::vector<char> of_triangles;
  of_triangles.reserve(places.parts.size());
  for (const std::uint32_t part : places.parts) of_triangles.push_back(flat[part]);
  return of_triangles;
}

}  // namespace meshrepair::internal
