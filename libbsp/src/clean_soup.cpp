// SPDX-License-Identifier: MIT
// From triangles in doubles to triangles on the working grid, the numbers of which all predicates
// are exact. Points are rounded once, here; those that come to one place are one point. Triangles
// that have no area there go, and the report says of how many rounding alone is to blame.
//
// Copies of a triangle become one, with a winding and a number of layers. One that is there as
// often either way winds around nothing. One that is there several times is one face, unless the
// edges around it are balanced only with all copies: then solids overlap with a face in common, and
// each copy counts (count_layers.h). Layers that only the grid has brought together add up, as the
// wall of something thin is no copy.
//
// Ids follow the order of the input, and tasks are joined in their order.
#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <base/error.h>
#include <base/first_equal.h>
#include <base/internal/hash_index.h>
#include <base/parallel.h>
#include <bsp/clean_soup.h>
#include <bsp/common_grid.h>
#include <bsp/internal/corners.h>
#include <exact/internal/grid_hash.h>
#include <mesh/mesh_limits.h>

#include "count_layers.h"

namespace meshrepair {
namespace {

using internal::CornerIds;
using internal::hash_of;
using internal::hash_of_corners;
using internal::same_orientation;
using internal::sorted_corners;

// Some milliseconds of work.
constexpr std::size_t kItemsPerTask = 32768;

// Which points are corners of triangles whose three corners are finite; throws on indices out of
// range.
std::vector<char> used_points(const TriangleSoup& soup, std::vector<char>& finite_triangle) {
  std::vector<char> finite(soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) finite[i] = soup.points[i].allFinite();
  std::vector<char> used(soup.points.size(), 0);
  finite_triangle.assign(soup.triangles.size(), 0);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& corner = soup.triangles[t];
    for (const std::uint32_t c : corner) {
      if (c >= soup.points.size()) {
        throw InputError("triangle " + std::to_string(t) + " refers to point " + std::to_string(c) +
                         ", but there are " + std::to_string(soup.points.size()) + " points");
      }
    }
    if (!finite[corner[0]] || !finite[corner[1]] || !finite[corner[2]]) continue;
    finite_triangle[t] = 1;
    for (const std::uint32_t c : corner) used[c] = 1;
  }
  return used;
}

// Fills points and grid_points; returns the new id of each used point.
std::vector<PointId> join_points(const TriangleSoup& soup, const std::vector<char>& used,
                                 CleanSoup& clean, CleanReport& report) {
  std::vector<std::uint32_t> given;  // those in use
  given.reserve(used.size());
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (used[i] != 0) given.push_back(i);
  }
  std::vector<GridPoint> at(given.size());
  parallel_tasks(given.size(), kItemsPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     at[i] = clean.grid.to_grid(soup.points[given[i]]);
                   }
                 });
  const std::vector<std::uint32_t> first = first_equal(
      given.size(), [&](std::size_t i) { return hash_of(at[i]); },
      [&](std::size_t i, std::size_t j) { return at[i] == at[j]; });
  clean.points.reserve(given.size());
  clean.grid_points.reserve(given.size());
  std::vector<PointId> id_of(soup.points.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Vec3d& point = soup.points[given[i]];
    PointId& id = id_of[given[i]];
    id = id_of[given[first[i]]];
    if (first[i] == i) {
      id = clean.grid_points.push_back(at[i]);
      clean.points.push_back(point);
    } else if (clean.points[id] != point) {
      ++report.joined_points;
    }
  }
  return id_of;
}

// Corners are in a line where their triangle is lower than this over its longest side, the largest
// coordinate being 1. Each coordinate was rounded twice, when it was made and when it was scaled,
// which moves a corner by up to sqrt(3) 2^-52 and changes the height by twice that at most; the
// cross product adds about as much. For the report alone: what is kept is decided on the grid.
constexpr double kFlat = 0x1p-48;

bool in_a_line(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double size = a.cwiseAbs().cwiseMax(b.cwiseAbs()).cwiseMax(c.cwiseAbs()).maxCoeff();
  if (size == 0) return true;
  const Vec3d u = b / size - a / size;
  const Vec3d v = c / size - a / size;
  const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
  return u.cross(v).norm() <= kFlat * longest;
}

Plane plane_of(const CleanSoup& clean, const CornerIds& corners) {
  const auto& at = clean.grid_points;
  return plane_through(at[corners[0]], at[corners[1]], at[corners[2]]);
}

// The corners of a triangle as given, on the grid.
class GridCorners {
 public:
  GridCorners(const TriangleSoup& soup, const std::vector<PointId>& id_of)
      : soup_(soup), id_of_(id_of) {}
  CornerIds operator[](std::size_t triangle) const {
    const auto& c = soup_.triangles[triangle];
    return {id_of_[c[0]], id_of_[c[1]], id_of_[c[2]]};
  }

 private:
  const TriangleSoup& soup_;
  const std::vector<PointId>& id_of_;
};

// Those that have an area on the grid, and in the report how many have none.
std::vector<std::uint32_t> find_triangles(const TriangleSoup& soup, const GridCorners& corners,
                                          const std::vector<char>& finite, const CleanSoup& clean,
                                          CleanReport& report) {
  struct Found {
    std::vector<std::uint32_t> triangles;
    std::size_t not_finite = 0, degenerate = 0, below_grid = 0;
  };
  const auto find = [&](std::size_t first, std::size_t last) {
    Found found;
    for (std::size_t t = first; t < last; ++t) {
      if (finite[t] == 0) {
        ++found.not_finite;
      } else if (!is_null(plane_of(clean, corners[t]))) {
        found.triangles.push_back(static_cast<std::uint32_t>(t));
      } else {
        const auto& c = soup.triangles[t];
        const bool flat = in_a_line(soup.points[c[0]], soup.points[c[1]], soup.points[c[2]]);
        ++(flat ? found.degenerate : found.below_grid);
      }
    }
    return found;
  };
  std::vector<std::uint32_t> all;
  parallel_reduce(soup.triangles.size(), kItemsPerTask, find, [&](Found&, const Found& found) {
    all.insert(all.end(), found.triangles.begin(), found.triangles.end());
    report.dropped_not_finite += found.not_finite;
    report.dropped_degenerate += found.degenerate;
    report.dropped_below_grid += found.below_grid;
  });
  return all;
}

// Which of the copies of a triangle count.
enum class Copies { as_edges_tell, all };

// Each triangle once, with its plane.
class TriangleCollector {
 public:
  TriangleCollector(const TriangleSoup& soup, CleanSoup& clean, CleanReport& report)
      : soup_(soup), clean_(clean), report_(report) {}

  void add(const std::vector<std::uint32_t>& all, const GridCorners& corners) {
    const std::vector<std::uint32_t> first = first_equal(
        all.size(), [&](std::size_t i) { return hash_of_corners(sorted_corners(corners[all[i]])); },
        [&](std::size_t i, std::size_t j) {
          return sorted_corners(corners[all[i]]) == sorted_corners(corners[all[j]]);
        });
    std::vector<TriangleId> id_of(all.size());
    clean_.triangles.reserve(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (first[i] == i) {
        id_of[i] = clean_.triangles.push_back({corners[all[i]], PlaneId(), 1, all[i]});
        continue;
      }
      id_of[i] = id_of[first[i]];
      const bool same = same_orientation(corners[all[first[i]]], corners[all[i]]);
      ++(same ? report_.duplicates : report_.opposite_duplicates);
      copies_.push_back({id_of[i], all[i], same ? 1 : -1});
    }
    find_planes();
  }

  // Says how those with copies are turned.
  void finish(Copies count) {
    std::vector<internal::CopiedTriangle> copied;
    std::stable_sort(copies_.begin(), copies_.end(),
                     [](const Copy& a, const Copy& b) { return a.of < b.of; });
    for (auto copy = copies_.begin(); copy != copies_.end();) {
      const TriangleId t = copy->of;
      layers_.assign(1, layer_of({t, clean_.triangles[t].source, 1}));
      std::int32_t all = 1;
      for (; copy != copies_.end() && copy->of == t; ++copy) {
        if (count != Copies::all) layers_.push_back(layer_of(*copy));
        all += copy->facing;
      }
      const std::int32_t facing = count == Copies::all ? all : std::clamp(sum_of_layers(), -1, 1);
      copied.push_back({t, facing, all});
    }
    internal::count_layers(clean_, copied);
  }

 private:
  struct Copy {
    TriangleId of;
    std::uint32_t source;
    int facing;  // 1 as the first of them, -1 the other way
  };

  // A copy where it was before it came onto the grid: the coordinates of its corners, in an order
  // that all copies have in common.
  struct Layer {
    std::array<double, 9> at;
    int facing;
    friend bool operator<(const Layer& a, const Layer& b) {
      return a.at != b.at ? a.at < b.at : a.facing < b.facing;
    }
    friend bool operator==(const Layer& a, const Layer& b) {
      return a.at == b.at && a.facing == b.facing;
    }
  };

  [[nodiscard]] Layer layer_of(const Copy& copy) const {
    std::array<Vec3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = soup_.points[soup_.triangles[copy.source][k]];
    }
    std::sort(corners.begin(), corners.end(), [&](const Vec3d& a, const Vec3d& b) {
      return clean_.grid.to_grid(a) < clean_.grid.to_grid(b);
    });
    Layer layer{{}, copy.facing};
    for (std::size_t i = 0; i < 9; ++i) layer.at[i] = corners[i / 3][static_cast<int>(i % 3)];
    return layer;
  }

  // A face that is there twice is one face, and with its reverse none; but layers nearer to each
  // other than the steps of the grid add up: of a thin wall and what it encloses, the one outside
  // is left.
  [[nodiscard]] int sum_of_layers() {
    std::sort(layers_.begin(), layers_.end());
    layers_.erase(std::unique(layers_.begin(), layers_.end()), layers_.end());
    int sum = 0;
    for (const Layer& layer : layers_) sum += layer.facing;
    return sum;
  }

  void find_planes() {
    IdVector<PlaneId, Plane> planes;
    planes.raw().resize_for_overwrite(clean_.triangles.size());
    parallel_tasks(planes.size(), kItemsPerTask,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t t = first; t < last; ++t) {
                       Triangle& triangle = clean_.triangles[TriangleId(t)];
                       Plane& plane = planes[PlaneId(t)];
                       plane = plane_of(clean_, triangle.corners);
                       if (make_canonical(plane)) triangle.winding = -1;
                     }
                   });
    const std::vector<PlaneId> ids = clean_.planes.take(std::move(planes));
    for (std::size_t t = 0; t < ids.size(); ++t) {
      clean_.triangles[TriangleId(t)].plane = ids[t];
    }
  }

  const TriangleSoup& soup_;
  CleanSoup& clean_;
  CleanReport& report_;
  std::vector<Copy> copies_;
  std::vector<Layer> layers_;
};

CleanSoup clean(const TriangleSoup& soup, const Grid& grid, Copies copies, CleanReport& report,
                ProgressObserver* progress) {
  require_points(soup.points.size());
  require_triangles(soup.triangles.size());
  CancelCheck check(progress);
  report = {};
  report.triangles_in = soup.triangles.size();
  std::vector<char> finite;
  const std::vector<char> used = used_points(soup, finite);
  CleanSoup result;
  result.grid = grid;
  report.grid_unit = result.grid.unit;
  const std::vector<PointId> id_of = join_points(soup, used, result, report);
  check.ask();
  const GridCorners corners(soup, id_of);
  TriangleCollector collector(soup, result, report);
  collector.add(find_triangles(soup, corners, finite, result, report), corners);
  check.ask();
  collector.finish(copies);
  return result;
}

}  // namespace

Grid make_grid(std::span<const TriangleSoup* const> soups) {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::infinity());
  Vec3d high = -low;
  for (const TriangleSoup* soup : soups) {
    std::vector<char> finite;
    const std::vector<char> used = used_points(*soup, finite);
    for (std::size_t i = 0; i < soup->points.size(); ++i) {
      if (!used[i]) continue;
      low = low.cwiseMin(soup->points[i]);
      high = high.cwiseMax(soup->points[i]);
    }
  }
  return low.x() <= high.x() ? make_grid(low, high) : Grid{};
}

CleanSoup clean_soup(const TriangleSoup& soup, CleanReport& report, ProgressObserver* progress) {
  const TriangleSoup* const all[] = {&soup};
  return clean_soup(soup, make_grid(all), report, progress);
}

CleanSoup clean_soup(const TriangleSoup& soup, const Grid& grid, CleanReport& report,
                     ProgressObserver* progress) {
  return clean(soup, grid, Copies::as_edges_tell, report, progress);
}

CleanSoup clean_surface(const TriangleSoup& mesh, CleanReport& report, ProgressObserver* progress) {
  const TriangleSoup* const all[] = {&mesh};
  return clean(mesh, make_grid(all), Copies::all, report, progress);
}

double area_of(const CleanSoup& soup, const Triangle& triangle) {
  const Vec3d& a = soup.points[triangle.corners[0]];
  const Vec3d& b = soup.points[triangle.corners[1]];
  const Vec3d& c = soup.points[triangle.corners[2]];
  return 0.5 * (b - a).cross(c - a).norm();
}

GridBox bounding_box(const CleanSoup& soup) {
  if (soup.grid_points.empty()) return {};
  GridPoint low = soup.grid_points[PointId(0u)];
  GridPoint high = low;
  for (const GridPoint& p : soup.grid_points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {low, high};
}

GridBox outer_box(const CleanSoup& soup) {
  const auto [low, high] = bounding_box(soup);
  const std::int32_t extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const std::int32_t margin = extent / 16 + 1;
  return {{low.x - margin, low.y - margin, low.z - margin},
          {high.x + margin, high.y + margin, high.z + margin}};
}

}  // namespace meshrepair
