#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <base/error.h>
#include <base/hash_index.h>
#include <bsp/clean_soup.h>
#include <bsp/common_grid.h>
#include <exact/grid_hash.h>

#include "count_layers.h"

namespace meshrepair {
namespace {

using internal::hash_mix;
using internal::hash_of;
using internal::HashIndex;
using Corners = std::array<PointId, 3>;

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
                                 CleanSoup& clean, CleanReport& report, CancelCheck& check) {
  const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
  clean.points.reserve(count);
  clean.grid_points.reserve(count);
  HashIndex index(count);
  std::vector<PointId> id_of(soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    if (!used[i]) continue;
    check.tick();
    const GridPoint at = clean.grid.to_grid(soup.points[i]);
    const PointId fresh = clean.grid_points.end_id();
    const PointId id(index.find_or_insert(hash_of(at), fresh.value, [&](std::uint32_t candidate) {
      return clean.grid_points[PointId(candidate)] == at;
    }));
    if (id == fresh) {
      clean.grid_points.push_back(at);
      clean.points.push_back(soup.points[i]);
    } else if (clean.points[id] != soup.points[i]) {
      ++report.joined_points;
    }
    id_of[i] = id;
  }
  return id_of;
}

// Whether b is a even permutation of a; both hold the same three ids.
bool same_orientation(const Corners& a, const Corners& b) {
  return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[2]) ||
         (a[0] == b[2] && a[1] == b[0]);
}

Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

std::uint64_t hash_of_corners(const Corners& sorted_corners) {
  return hash_mix(hash_mix(hash_mix(0, sorted_corners[0].value), sorted_corners[1].value),
                  sorted_corners[2].value);
}

class TriangleCollector {
 public:
  TriangleCollector(const TriangleSoup& soup, CleanSoup& clean, CleanReport& report)
      : soup_(soup), clean_(clean), report_(report), index_(soup.triangles.size()) {
    clean_.triangles.reserve(soup.triangles.size());
  }

  // False where there is no triangle: the corners are equal or in a line, on the grid.
  bool add(const Corners& corners, std::uint32_t source) {
    const auto& at = clean_.grid_points;
    Plane plane = plane_through(at[corners[0]], at[corners[1]], at[corners[2]]);
    if (is_null(plane)) return false;
    const Corners key = sorted(corners);
    const TriangleId fresh = clean_.triangles.end_id();
    const TriangleId id(
        index_.find_or_insert(hash_of_corners(key), fresh.value, [&](std::uint32_t candidate) {
          return sorted(clean_.triangles[TriangleId(candidate)].corners) == key;
        }));
    if (id == fresh) {
      const auto interned = clean_.planes.intern(plane);
      clean_.triangles.push_back({corners, interned.id, interned.turned ? -1 : 1, source});
    } else {
      const bool same = same_orientation(clean_.triangles[id].corners, corners);
      ++(same ? report_.duplicates : report_.opposite_duplicates);
      copies_.push_back({id, source, same ? 1 : -1});
    }
    return true;
  }

  // Says how those with copies are turned.
  void finish() {
    std::vector<internal::CopiedTriangle> copied;
    std::stable_sort(copies_.begin(), copies_.end(),
                     [](const Copy& a, const Copy& b) { return a.of < b.of; });
    for (auto copy = copies_.begin(); copy != copies_.end();) {
      const TriangleId t = copy->of;
      layers_.assign(1, layer_of({t, clean_.triangles[t].source, 1}));
      std::int32_t all = 1;
      for (; copy != copies_.end() && copy->of == t; ++copy) {
        layers_.push_back(layer_of(*copy));
        all += copy->facing;
      }
      const int sum = sum_of_layers();
      copied.push_back({t, sum > 0 ? 1 : sum < 0 ? -1 : 0, all});
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

  const TriangleSoup& soup_;
  CleanSoup& clean_;
  CleanReport& report_;
  HashIndex index_;
  std::vector<Copy> copies_;
  std::vector<Layer> layers_;
};

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
  CancelCheck check(progress);
  report = {};
  report.triangles_in = soup.triangles.size();
  std::vector<char> finite;
  const std::vector<char> used = used_points(soup, finite);
  CleanSoup clean;
  clean.grid = grid;
  report.grid_unit = clean.grid.unit;
  const std::vector<PointId> id_of = join_points(soup, used, clean, report, check);
  TriangleCollector collector(soup, clean, report);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    check.tick();
    if (!finite[t]) {
      ++report.dropped_not_finite;
      continue;
    }
    const auto& c = soup.triangles[t];
    if (collector.add({id_of[c[0]], id_of[c[1]], id_of[c[2]]}, static_cast<std::uint32_t>(t))) {
      continue;
    }
    const bool flat = in_a_line(soup.points[c[0]], soup.points[c[1]], soup.points[c[2]]);
    ++(flat ? report.dropped_degenerate : report.dropped_below_grid);
  }
  collector.finish();
  return clean;
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
