// SPDX-License-Identifier: MIT
// Moving points until no triangle around them is at fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <base/progress.h>
#include <check/internal/nearby_intersections.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Triangles are at fault that intersect others or are degenerate, and points of a group that are in
// one place.
class PointMover {
 public:
  // `points` of the mesh may move, `group` says of each which it belongs to: 0, 1, ... Faults are
  // counted, and moves taken back, by group. No point will be moved by more than `reach` in all.
  // The mesh must outlive it.
  PointMover(TriangleSoup& mesh, std::vector<std::uint32_t> points,
             std::vector<std::uint32_t> group, double reach, ProgressObserver* progress);

  [[nodiscard]] std::size_t faults() const { return total(faults_.of_group); }
  [[nodiscard]] std::uint32_t faults_of(std::uint32_t group) const {
    return faults_.of_group[group];
  }
  // Triangles with a corner that may move.
  [[nodiscard]] std::size_t triangles() const { return near_.size(); }

  // Moves the points of groups at fault to where `moved` says, by their position in `points`. Takes
  // back what did not help there, and all if the whole is no better.
  void try_moves(const std::function<Vec3d(std::size_t)>& moved);

 private:
  struct Faults {
    std::vector<NearbyIntersections::Pair> pairs;  // a degenerate triangle is one with itself
    std::vector<std::uint32_t> of_group;
  };

  [[nodiscard]] static std::size_t total(const std::vector<std::uint32_t>& faults);
  // `changed` since `before` was counted.
  [[nodiscard]] Faults count_faults(const Faults& before,
                                    const std::vector<std::uint32_t>& changed);
  // With a point of a group that has a flag.
  [[nodiscard]] std::vector<std::uint32_t> triangles_of(const std::vector<char>& groups) const;
  void blame(std::vector<std::uint32_t>& faults, std::uint32_t triangle) const;
  void count_points_in_one_place(std::vector<std::uint32_t>& faults) const;

  TriangleSoup& mesh_;
  std::vector<std::uint32_t> points_;
  std::vector<std::uint32_t> group_;     // of each of points_
  std::vector<std::uint32_t> group_at_;  // of each point of the mesh, or kNone
  std::vector<std::uint32_t> near_;      // triangles
  NearbyIntersections intersections_;
  Faults faults_;
  CancelOnly progress_;
};

}  // namespace meshrepair::internal
