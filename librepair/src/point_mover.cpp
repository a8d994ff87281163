#include "point_mover.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include <bsp/double_predicates.h>
#include <extract/self_intersections.h>

namespace meshrepair::internal {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

// More say no more about which points are to blame.
constexpr std::size_t kMostPairs = 200'000;

bool is_degenerate(const TriangleSoup& mesh, std::uint32_t t) {
  const auto& c = mesh.triangles[t];
  return projection_axis(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]) < 0;
}

}  // namespace

PointMover::PointMover(TriangleSoup& mesh, std::vector<std::uint32_t> points,
                       std::vector<std::uint32_t> group, ProgressObserver* progress)
    : mesh_(mesh), points_(std::move(points)), group_(std::move(group)), progress_(progress) {
  group_at_.assign(mesh_.points.size(), kNone);
  for (std::size_t i = 0; i < points_.size(); ++i) group_at_[points_[i]] = group_[i];
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& corners = mesh_.triangles[t];
    if (std::any_of(corners.begin(), corners.end(),
                    [&](std::uint32_t p) { return group_at_[p] != kNone; })) {
      near_.push_back(t);
    }
  }
  const std::size_t groups =
      group_.empty() ? 0 : std::size_t{*std::max_element(group_.begin(), group_.end())} + 1;
  faults_.resize(groups);
  faults_ = count_faults();
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

std::vector<std::uint32_t> PointMover::count_faults() const {
  std::vector<std::uint32_t> faults(faults_.size(), 0);
  if (near_.empty()) return faults;
  SelfIntersectionOptions options;
  options.most_pairs = kMostPairs;
  options.progress = progress_;
  for (const auto& pair : self_intersections(mesh_, near_, options).pairs) {
    blame(faults, pair[0]);
    blame(faults, pair[1]);
  }
  for (const std::uint32_t t : near_) {
    if (is_degenerate(mesh_, t)) blame(faults, t);
  }
  count_points_in_one_place(faults);
  return faults;
}

void PointMover::try_moves(const std::function<Vec3d(std::size_t)>& moved) {
  std::vector<Vec3d> before(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    before[i] = mesh_.points[points_[i]];
    if (faults_[group_[i]] > 0) mesh_.points[points_[i]] = moved(i);
  }
  std::vector<std::uint32_t> after = count_faults();
  if (total(after) >= total(faults_)) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (after[group_[i]] >= faults_[group_[i]]) mesh_.points[points_[i]] = before[i];
    }
    after = count_faults();
  }
  if (total(after) < total(faults_)) {
    faults_ = std::move(after);
    return;
  }
  for (std::size_t i = 0; i < points_.size(); ++i) mesh_.points[points_[i]] = before[i];
}

}  // namespace meshrepair::internal
