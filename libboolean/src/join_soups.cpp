// SPDX-License-Identifier: MIT
#include "join_soups.h"

#include <base/error.h>
#include <base/internal/hash_index.h>
#include <bsp/internal/corners.h>
#include <exact/internal/grid_hash.h>

namespace meshrepair::internal {
namespace {

bool is_same_grid(const Grid& a, const Grid& b) { return a.unit == b.unit && a.origin == b.origin; }

class Joiner {
 public:
  Joiner(const CleanSoup& first, const CleanSoup& second, std::uint32_t second_source, JoinMap& map)
      : first_(first),
        second_(second),
        second_source_(second_source),
        map_(map),
        triangles_(first.triangles.size() + second.triangles.size()) {}

  CleanSoup run() {
    joined_.grid = first_.grid;
    joined_.points = first_.points;
    joined_.grid_points = first_.grid_points;
    joined_.planes = first_.planes;
    join_points();
    map_.second_plane.clear();
    for (PlaneId p(0u); p.index() < second_.planes.size(); ++p.value) {
      map_.second_plane.push_back(joined_.planes.intern(second_.planes[p]).id);
    }
    map_.first_triangle.assign(first_.triangles.size(), {});
    map_.second_triangle.assign(second_.triangles.size(), {});
    for (const bool with_source : {true, false}) {
      add_triangles_of_first(with_source);
      add_triangles_of_second(with_source);
    }
    return std::move(joined_);
  }

 private:
  void join_points() {
    HashIndex index(first_.grid_points.size() + second_.grid_points.size());
    const auto find = [&](const GridPoint& at, PointId fresh) {
      return PointId(index.find_or_insert(hash_of(at), fresh.value, [&](std::uint32_t known) {
        return joined_.grid_points[PointId(known)] == at;
      }));
    };
    for (PointId p(0u); p < first_.grid_points.end_id(); ++p.value) {
      find(first_.grid_points[p], p);
    }
    for (PointId p(0u); p < second_.grid_points.end_id(); ++p.value) {
      const PointId fresh = joined_.grid_points.end_id();
      const PointId id = find(second_.grid_points[p], fresh);
      if (id == fresh) {
        joined_.grid_points.push_back(second_.grid_points[p]);
        joined_.points.push_back(second_.points[p]);
      }
      second_point_.push_back(id);
    }
  }

  void add_triangles_of_first(bool with_source) {
    for (TriangleId t(0u); t < first_.triangles.end_id(); ++t.value) {
      const Triangle& triangle = first_.triangles[t];
      if ((triangle.source != Triangle::kNoSource) != with_source) continue;
      map_.first_triangle[t] = add(triangle);
    }
  }

  void add_triangles_of_second(bool with_source) {
    for (TriangleId t(0u); t < second_.triangles.end_id(); ++t.value) {
      Triangle triangle = second_.triangles[t];
      if ((triangle.source != Triangle::kNoSource) != with_source) continue;
      for (PointId& corner : triangle.corners) corner = second_point_[corner];
      triangle.plane = map_.second_plane[triangle.plane];
      if (with_source) triangle.source += second_source_;
      map_.second_triangle[t] = add(triangle);
    }
  }

  TriangleId add(const Triangle& triangle) {
    const CornerIds key = sorted_corners(triangle.corners);
    const TriangleId fresh = joined_.triangles.end_id();
    const TriangleId id(
        triangles_.find_or_insert(hash_of_corners(key), fresh.value, [&](std::uint32_t known) {
          return sorted_corners(joined_.triangles[TriangleId(known)].corners) == key;
        }));
    if (id == fresh) {
      joined_.triangles.push_back(triangle);
    } else if (joined_.triangles[id].winding != triangle.winding) {
      joined_.triangles[id].winding = 0;
    }
    return id;
  }

  const CleanSoup& first_;
  const CleanSoup& second_;
  std::uint32_t second_source_;
  JoinMap& map_;
  CleanSoup joined_;
  HashIndex triangles_;
  IdVector<PointId, PointId> second_point_;
};

}  // namespace

CleanSoup join_soups(const CleanSoup& first, const CleanSoup& second, std::uint32_t second_source,
                     JoinMap& map) {
  if (!is_same_grid(first.grid, second.grid)) {
    throw InputError("the two are on different grids");
  }
  return Joiner(first, second, second_source, map).run();
}

}  // namespace meshrepair::internal
