#include "nudge_points.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <bsp/double_predicates.h>
#include <bsp/float32.h>
#include <bsp/hash_index.h>

#include "number_spacing.h"

namespace meshrepair::internal {
namespace {

constexpr std::uint32_t kTries = 24;
// Beyond this there are too many faults for chance to be a remedy.
constexpr std::size_t kMostTriangles = 20'000;

class PointNudger {
 public:
  PointNudger(Surface& surface, Precision precision, ProgressObserver* progress)
      : surface_(surface), mesh_(surface.mesh), precision_(precision), progress_(progress) {}

  void run(const std::vector<std::uint32_t>& at_fault) {
    if (at_fault.size() > kMostTriangles) return;
    find_movable(at_fault);
    if (movable_.empty()) return;
    count_faults(faults_);
    for (std::uint32_t k = 0; k < kTries && total(faults_) > 0; ++k) try_once(k);
  }

 private:
  void find_movable(const std::vector<std::uint32_t>& at_fault) {
    place_.assign(mesh_.points.size(), kNone);
    for (const std::uint32_t t : at_fault) {
      for (const std::uint32_t p : mesh_.triangles[t]) {
        if (surface_.input_point[p] != 0 || place_[p] != kNone) continue;
        place_[p] = static_cast<std::uint32_t>(movable_.size());
        movable_.push_back(p);
      }
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& corners = mesh_.triangles[t];
      if (std::any_of(corners.begin(), corners.end(),
                      [&](std::uint32_t p) { return place_[p] != kNone; })) {
        near_.push_back(t);
      }
    }
  }

  // For each movable point how often a triangle of its is at fault.
  void count_faults(std::vector<std::uint32_t>& faults) const {
    faults.assign(movable_.size(), 0);
    const auto blame = [&](std::uint32_t triangle) {
      for (const std::uint32_t p : mesh_.triangles[triangle]) {
        if (place_[p] != kNone) ++faults[place_[p]];
      }
    };
    SelfIntersectionOptions options;
    options.most_pairs = 10 * kMostTriangles;
    options.progress = progress_;
    for (const auto& pair : self_intersections(mesh_, near_, options).pairs) {
      blame(pair[0]);
      blame(pair[1]);
    }
    for (const std::uint32_t t : near_) {
      const auto& c = mesh_.triangles[t];
      if (projection_axis(mesh_.points[c[0]], mesh_.points[c[1]], mesh_.points[c[2]]) < 0) blame(t);
    }
  }

  [[nodiscard]] static std::size_t total(const std::vector<std::uint32_t>& faults) {
    std::size_t sum = 0;
    for (const std::uint32_t f : faults) sum += f;
    return sum;
  }

  // Moves every point at fault; takes back what did not help there, and all if the whole got worse.
  void try_once(std::uint32_t k) {
    std::vector<Vec3d> before(movable_.size());
    for (std::size_t i = 0; i < movable_.size(); ++i) {
      before[i] = mesh_.points[movable_[i]];
      if (faults_[i] > 0) mesh_.points[movable_[i]] = moved(before[i], i, k);
    }
    std::vector<std::uint32_t> after;
    count_faults(after);
    if (total(after) >= total(faults_)) {
      for (std::size_t i = 0; i < movable_.size(); ++i) {
        if (after[i] >= faults_[i]) mesh_.points[movable_[i]] = before[i];
      }
      count_faults(after);
    }
    if (total(after) < total(faults_)) {
      faults_ = std::move(after);
      return;
    }
    for (std::size_t i = 0; i < movable_.size(); ++i) mesh_.points[movable_[i]] = before[i];
  }

  [[nodiscard]] Vec3d moved(const Vec3d& from, std::size_t i, std::uint32_t k) const {
    Vec3d to = from;
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint64_t chance = hash_mix(hash_mix(i + 1, k), static_cast<std::uint64_t>(axis));
      const auto reach = static_cast<std::int64_t>(1) << (k / 4);
      const std::int64_t steps =
          static_cast<std::int64_t>((chance >> 20) % static_cast<std::uint64_t>(2 * reach + 1)) -
          reach;
      to[axis] +=
          static_cast<double>(steps) * number_spacing(from.cwiseAbs().maxCoeff(), precision_);
      if (precision_ == Precision::float32) to[axis] = rounded_to_float32(to[axis]);
    }
    return to;
  }

  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  Surface& surface_;
  TriangleSoup& mesh_;
  Precision precision_;
  ProgressObserver* progress_;
  std::vector<std::uint32_t> movable_;  // points
  std::vector<std::uint32_t> place_;    // of each point in movable_, or kNone
  std::vector<std::uint32_t> near_;     // triangles with a movable corner
  std::vector<std::uint32_t> faults_;   // of each movable point
};

std::vector<std::uint32_t> triangles_at_fault(const TriangleSoup& mesh,
                                              const SelfIntersections& found) {
  std::vector<std::uint32_t> triangles;
  for (const auto& pair : found.pairs) {
    triangles.insert(triangles.end(), pair.begin(), pair.end());
  }
  if (found.degenerate > 0) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& c = mesh.triangles[t];
      if (projection_axis(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]) < 0) {
        triangles.push_back(t);
      }
    }
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace

void nudge_points(Surface& surface, const SelfIntersections& found, Precision precision,
                  ProgressObserver* progress) {
  PointNudger(surface, precision, progress).run(triangles_at_fault(surface.mesh, found));
}

}  // namespace meshrepair::internal
