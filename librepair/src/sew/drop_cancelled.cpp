#include "drop_cancelled.h"

#include <algorithm>
#include <utility>

namespace meshrepair::internal {
namespace {

bool is_cancelled(const Triangle& triangle) { return triangle.winding == 0; }

void drop_unused_points(CleanSoup& soup) {
  IdVector<PointId, char> is_used(soup.points.size(), 0);
  for (const Triangle& t : soup.triangles) {
    for (const PointId p : t.corners) is_used[p] = 1;
  }
  IdVector<PointId, PointId> becomes(soup.points.size());
  IdVector<PointId, Vec3d> points;
  IdVector<PointId, GridPoint> grid_points;
  for (PointId p(0u); p < soup.points.end_id(); ++p.value) {
    if (is_used[p] == 0) continue;
    becomes[p] = points.push_back(soup.points[p]);
    grid_points.push_back(soup.grid_points[p]);
  }
  for (Triangle& t : soup.triangles) {
    for (PointId& p : t.corners) p = becomes[p];
  }
  soup.points = std::move(points);
  soup.grid_points = std::move(grid_points);
}

}  // namespace

std::size_t drop_cancelled(CleanSoup& soup) {
  const auto& all = soup.triangles;
  const auto count = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_cancelled));
  if (count == 0) return 0;
  IdVector<TriangleId, Triangle> triangles;
  triangles.reserve(all.size() - count);
  for (const Triangle& t : all) {
    if (!is_cancelled(t)) triangles.push_back(t);
  }
  soup.triangles = std::move(triangles);
  drop_unused_points(soup);
  return count;
}

}  // namespace meshrepair::internal
