#include <algorithm>
#include <utility>

#include <mesh/collapsible_mesh.h>

namespace meshrepair::internal {

CollapsibleMesh::CollapsibleMesh(std::vector<std::array<std::uint32_t, 3>> triangles,
                                 std::size_t points)
    : triangles_(std::move(triangles)),
      left_(triangles_.size(), 1),
      next_(3 * triangles_.size(), kNone),
      first_(points, kNone),
      last_(points, kNone),
      degree_(points, 0),
      marked_by_(points, 0) {
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      append(triangles_[t][k], 3 * t + k);
      ++degree_[triangles_[t][k]];
    }
  }
}

void CollapsibleMesh::append(std::uint32_t point, std::uint32_t corner) {
  next_[corner] = kNone;
  (last_[point] == kNone ? first_[point] : next_[last_[point]]) = corner;
  last_[point] = corner;
}

// Corners of triangles that are gone leave the list on the way.
template <class Visit>
void CollapsibleMesh::visit_corners(std::uint32_t point, const Visit& visit) {
  std::uint32_t before = kNone;
  for (std::uint32_t corner = first_[point]; corner != kNone; corner = next_[corner]) {
    const std::uint32_t t = corner / 3, k = corner % 3;
    if (left_[t] == 0) continue;
    (before == kNone ? first_[point] : next_[before]) = corner;
    before = corner;
    visit(t, triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3]);
  }
  (before == kNone ? first_[point] : next_[before]) = kNone;
  last_[point] = before;
}

bool CollapsibleMesh::find_star(std::uint32_t point, PointStar& star) {
  star.point = point;
  star.link.clear();
  star.triangles.clear();
  const std::size_t size = degree_[point];
  if (size < 3 || size > kMostOfStar) return false;
  std::array<std::uint32_t, kMostOfStar> ends{};
  visit_corners(point, [&](std::uint32_t t, std::uint32_t from, std::uint32_t to) {
    ends[star.link.size()] = to;
    star.link.push_back(from);
    star.triangles.push_back(t);
  });
  for (std::size_t i = 0; i + 1 < size; ++i) {
    std::size_t k = i + 1;
    while (k < size && star.link[k] != ends[i]) ++k;
    if (k == size) return false;
    std::swap(star.link[i + 1], star.link[k]);
    std::swap(star.triangles[i + 1], star.triangles[k]);
    std::swap(ends[i + 1], ends[k]);
  }
  return ends[size - 1] == star.link[0] &&
         std::none_of(star.link.begin(), star.link.end(),
                      [&](std::uint32_t p) { return degree_[p] > kMostOfNeighbour; });
}

bool CollapsibleMesh::may_collapse(const PointStar& star, std::size_t to) {
  const std::uint32_t target = star.link[to];
  if (degree_[target] + star.link.size() < 7) return false;
  if (degree_[star.link[star.before(to)]] < 4 || degree_[star.link[star.after(to)]] < 4) {
    return false;
  }
  ++mark_;
  for (const std::uint32_t p : star.link) marked_by_[p] = mark_;
  std::size_t common = 0;
  visit_corners(target, [&](std::uint32_t, std::uint32_t neighbour, std::uint32_t) {
    common += marked_by_[neighbour] == mark_ ? 1 : 0;
  });
  return common == 2;
}

void CollapsibleMesh::collapse(const PointStar& star, std::size_t to) {
  const std::uint32_t target = star.link[to];
  left_[star.triangles[to]] = 0;
  left_[star.triangles[star.before(to)]] = 0;
  for (const std::uint32_t t : star.triangles) {
    if (left_[t] == 0) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (triangles_[t][k] != star.point) continue;
      triangles_[t][k] = target;
      append(target, 3 * t + k);
    }
  }
  --degree_[star.link[star.before(to)]];
  --degree_[star.link[star.after(to)]];
  degree_[target] += static_cast<std::uint32_t>(star.link.size());
  degree_[target] -= 4;
  degree_[star.point] = 0;
  first_[star.point] = last_[star.point] = kNone;
}

}  // namespace meshrepair::internal
