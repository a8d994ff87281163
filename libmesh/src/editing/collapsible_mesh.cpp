// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include <mesh/internal/collapsible_mesh.h>

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

void CollapsibleMesh::drop_gone(std::uint32_t point) {
  visit_corners(point, [](std::uint32_t, std::uint32_t, std::uint32_t) {});
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

void CollapsibleMesh::restore(std::uint32_t point, std::uint32_t target,
                              std::span<const std::uint32_t> triangles) {
  // Two went with the move; each has a corner at both points, and a third one.
  std::array<std::uint32_t, 2> gone{};
  std::size_t count = 0;
  for (const std::uint32_t t : triangles) {
    if (left_[t] == 0) gone[count++] = t;
  }
  for (const std::uint32_t t : gone) {
    for (const std::uint32_t p : triangles_[t]) {
      if (p == point || p == target) continue;
      drop_gone(p);
      ++degree_[p];
    }
  }
  // The others leave the list of the target.
  for (const std::uint32_t t : triangles) left_[t] = 0;
  drop_gone(target);
  for (const std::uint32_t t : triangles) {
    left_[t] = 1;
    const bool goes_back = t != gone[0] && t != gone[1];
    for (std::uint32_t k = 0; k < 3; ++k) {
      std::uint32_t& corner = triangles_[t][k];
      if (goes_back && corner == target) corner = point;
      if (corner == point || !goes_back) append(corner, 3 * t + k);
    }
  }
  degree_[target] -= static_cast<std::uint32_t>(triangles.size()) - 4;
  degree_[point] = static_cast<std::uint32_t>(triangles.size());
}

}  // namespace meshrepair::internal
