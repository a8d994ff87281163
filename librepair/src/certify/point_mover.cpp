// SPDX-License-Identifier: MIT
#include "point_mover.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <base/ids.h>
#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

bool is_degenerate(const TriangleSoup& mesh, std::uint32_t t) {
  const auto& c = mesh.triangles[t];
  return projection_axis(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]) < 0;
}

std::vector<std::uint32_t> groups_of_points(std::size_t mesh_points,
                                            const std::vector<std::uint32_t>& points,
                                            const std::vector<std::uint32_t>& group) {
  std::vector<std::uint32_t> group_at(mesh_points, kNone);
  for (std::size_t i = 0; i < points.size(); ++i) group_at[points[i]] = group[i];
  return group_at;
}

std::vector<std::uint32_t> triangles_at(const TriangleSoup& mesh,
                                        const std::vector<std::uint32_t>& group_at) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    if (std::any_of(corners.begin(), corners.end(),
                    [&](std::uint32_t p) { return group_at[p] != kNone; })) {
      triangles.push_back(t);
    }
  }
  return triangles;
}

}  // namespace

PointMover::PointMover(TriangleSoup& mesh, std::vector<std::uint32_t> points,
                       std::vector<std::uint32_t> group, double reach, ProgressObserver* progress)
    : mesh_(mesh),
      points_(std::move(points)),
      group_(std::move(group)),
      group_at_(groups_of_points(mesh.points.size(), points_, group_)),
      near_(triangles_at(mesh, group_at_)),
      intersections_(mesh, near_, reach),
      progress_(progress) {
  if (group_.empty()) return;
  faults_.of_group.resize(std::size_t{*std::max_element(group_.begin(), group_.end())} + 1);
  faults_ = count_faults({}, near_);
}

std::size_t PointMover::total(const std::vector<std::uint32_t>& faults) {
  return std::accumulate(faults.begin(), faults.end(), std::size_t{0});
}

void PointMover::blame(std::vector<std::uint32_t>& faults, std::uint32_t triangle) const {
  for (const std::uint32_t p : mesh_.triangles[triangle]) {
    if (group_at_[p] != kNone) ++faults[group_at_[p]];
  }
}

void PointMover::count_points_in_one_place(std::vector<std::uint32_t>& faults) const {
  std::vector<std::pair<std::uint32_t, std::array<double, 3>>> places;
  places.reserve(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3d& p = mesh_.points[points_[i]];
    places.push_back({group_[i], {p.x(), p.y(), p.z()}});
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i] == places[i - 1]) ++faults[places[i].first];
  }
}

std::vector<std::uint32_t> PointMover::triangles_of(const std::vector<char>& groups) const {
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t t : near_) {
    const auto& corners = mesh_.triangles[t];
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t p) {
          return group_at_[p] != kNone && groups[group_at_[p]] != 0;
        })) {
      triangles.push_back(t);
    }
  }
  return triangles;
}

PointMover::Faults PointMover::count_faults(const Faults& before,
                                            const std::vector<std::uint32_t>& changed) {
  const auto is_changed = [&](std::uint32_t t) {
    return std::binary_search(changed.begin(), changed.end(), t);
  };
  Faults faults{intersections_.find(changed, &progress_), {}};
  for (const std::uint32_t t : changed) {
    if (is_degenerate(mesh_, t)) faults.pairs.push_back({t, t});
  }
  for (const auto& pair : before.pairs) {
    if (!is_changed(pair[0]) && !is_changed(pair[1])) faults.pairs.push_back(pair);
  }
  faults.of_group.assign(faults_.of_group.size(), 0);
  for (const auto& pair : faults.pairs) {
    blame(faults.of_group, pair[0]);
    if (pair[1] != pair[0]) blame(faults.of_group, pair[1]);
  }
  count_points_in_one_place(faults.of_group);
  return faults;
}

void PointMover::try_moves(const std::function<Vec3d(std::size_t)>& moved) {
  std::vector<Vec3d> before(points_.size());
  std::vector<char> is_moved;  // of each group
  for (const std::uint32_t faults : faults_.of_group) is_moved.push_back(faults > 0 ? 1 : 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    before[i] = mesh_.points[points_[i]];
    if (is_moved[group_[i]] != 0) mesh_.points[points_[i]] = moved(i);
  }
  Faults after = count_faults(faults_, triangles_of(is_moved));
  if (total(after.of_group) >= faults()) {
    for (std::uint32_t g = 0; g < is_moved.size(); ++g) {
      if (after.of_group[g] < faults_of(g)) is_moved[g] = 0;
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (is_moved[group_[i]] != 0) mesh_.points[points_[i]] = before[i];
    }
    after = count_faults(after, triangles_of(is_moved));
  }
  if (total(after.of_group) < faults()) {
    faults_ = std::move(after);
    return;
  }
  for (std::size_t i = 0; i < points_.size(); ++i) mesh_.points[points_[i]] = before[i];
}

}  // namespace meshrepair::internal
