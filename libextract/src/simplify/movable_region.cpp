// SPDX-License-Identifier: MIT
#include "movable_region.h"

#include <algorithm>

#include <mesh/edge_table.h>

namespace meshrepair::internal {
namespace {

bool has_any(const IndexTriangle& triangle, const std::vector<char>& marked) {
  return marked[triangle[0]] != 0 || marked[triangle[1]] != 0 || marked[triangle[2]] != 0;
}

// The corners of all triangles that have a marked one.
std::vector<char> with_neighbours(const TriangleSoup& mesh, const std::vector<char>& marked) {
  std::vector<char> wider(marked.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    if (!has_any(triangle, marked)) continue;
    for (const std::uint32_t p : triangle) wider[p] = 1;
  }
  return wider;
}

}  // namespace

MovableRegion::MovableRegion(const TriangleSoup& whole, const std::vector<char>& stays,
                             const std::vector<double>& within,
                             std::span<const std::uint32_t> source) {
  std::vector<char> moves(stays.size());
  std::transform(stays.begin(), stays.end(), moves.begin(),
                 [](char stay) { return static_cast<char>(stay == 0); });
  const std::vector<char> looked_at = with_neighbours(whole, moves);
  std::vector<std::uint32_t> number(whole.points.size(), 0);
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
    if (!has_any(whole.triangles[t], looked_at)) continue;
    triangles_.push_back(t);
    if (!source.empty()) source_.push_back(source[t]);
    for (const std::uint32_t p : whole.triangles[t]) number[p] = 1;
  }
  for (std::uint32_t p = 0; p < number.size(); ++p) {
    if (number[p] == 0) continue;
    number[p] = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    mesh_.points.push_back(whole.points[p]);
    stays_.push_back(stays[p]);
    within_.push_back(within[p]);
  }
  for (const std::uint32_t t : triangles_) {
    const auto& corners = whole.triangles[t];
    mesh_.triangles.push_back({number[corners[0]], number[corners[1]], number[corners[2]]});
  }
}

void MovableRegion::copy_stays(std::vector<char>& stays_of_whole) const {
  for (std::size_t p = 0; p < points_.size(); ++p) stays_of_whole[points_[p]] = stays_[p];
}

std::optional<std::uint32_t> MovableRegion::find(std::uint32_t triangle_of_whole) const {
  const auto at = std::lower_bound(triangles_.begin(), triangles_.end(), triangle_of_whole);
  if (at == triangles_.end() || *at != triangle_of_whole) return std::nullopt;
  return static_cast<std::uint32_t>(at - triangles_.begin());
}

}  // namespace meshrepair::internal
