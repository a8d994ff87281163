// SPDX-License-Identifier: MIT
#include "cut_set.h"

#include <algorithm>

#include <base/ids.h>
#include <exact/plane.h>

namespace meshrepair::internal {
int corner_side(const CleanSoup& soup, std::uint32_t triangle) {
  const Triangle& t = soup.triangles[TriangleId(triangle)];
  const Plane as_turned =
      plane_through(soup.grid_points[t.corners[0]], soup.grid_points[t.corners[1]],
                    soup.grid_points[t.corners[2]]);
  const Plane& plane = soup.planes[t.plane];
  const auto axis = static_cast<std::size_t>(dominant_axis(plane));
  return (as_turned.normal[axis] > 0) == (plane.normal[axis] > 0) ? 1 : -1;
}

CutSet::CutSet(const CleanSoup& soup, std::span<const Pair> pairs)
    : soup_(soup), number_(soup.triangles.size(), kNone) {
  for (const Pair& pair : pairs) {
    for (const std::uint32_t t : pair) number_[t] = 0;
  }
  for (std::uint32_t t = 0; t < number_.size(); ++t) {
    if (number_[t] == kNone) continue;
    number_[t] = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(t);
    const Triangle& triangle = soup.triangles[TriangleId(t)];
    corners_.push_back(
        {triangle.corners[0].value, triangle.corners[1].value, triangle.corners[2].value});
    side_.push_back(static_cast<std::int8_t>(corner_side(soup, t)));
  }
  list_planes();
  list_edges();
}

// Those of the soup have ids that say which are equal; they get new ones in the same order.
void CutSet::list_planes() {
  std::vector<PlaneId> ids;
  ids.reserve(size());
  for (const std::uint32_t t : triangles_) ids.push_back(soup_.triangles[TriangleId(t)].plane);
  std::vector<PlaneId> unique = ids;
  std::sort(unique.begin(), unique.end());
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
  planes_.reserve(unique.size() + 3 * size() / 2);
  for (const PlaneId id : unique) planes_.append(soup_.planes[id]);
  for (const PlaneId id : ids) {
    const auto at = std::lower_bound(unique.begin(), unique.end(), id) - unique.begin();
    plane_.emplace_back(static_cast<std::uint32_t>(at));
  }
}

void CutSet::list_edges() {
  edge_of_side_.resize(3 * size());
  const EdgeTable table(corners_);
  ends_.reserve(table.edges());
  edge_planes_.reserve(table.edges());
  table.for_each_edge([&](std::span<const std::uint32_t> sides) {
    const auto edge = static_cast<std::uint32_t>(ends_.size());
    for (const std::uint32_t s : sides) edge_of_side_[s] = edge;
    const std::uint32_t start = side_start(corners_, sides[0]);
    const std::uint32_t end = side_start(corners_, next_side(sides[0]));
    const std::uint32_t a = std::min(start, end), b = std::max(start, end);
    ends_.push_back({a, b});
    const PlaneId beside = plane_[sides[0] / 3];
    const Plane across =
        plane_along_axis(soup_.grid_points[PointId(a)], soup_.grid_points[PointId(b)],
                         dominant_axis(planes_[beside]));
    edge_planes_.push_back({beside, planes_.append(across)});
  });
}

}  // namespace meshrepair::internal
