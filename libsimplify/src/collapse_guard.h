// SPDX-License-Identifier: MIT
// May an edge be collapsed to a place without spoiling the solid?
//
// The new triangles around the place are a fan. It must not turn any triangle over, and none may
// be flat; the fan must not meet itself, or anything near it, beyond corners and edges in common,
// which is tested exactly. What remains is that the old and the new fan, which bound a volume
// together, swallow something whole: another part, which its one point tells that the guard keeps
// of it; or all the rest of the same part, which is then smaller than that volume.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <check/internal/triangle_pair.h>
#include <mesh/internal/collapsible_mesh.h>
#include <mesh/mesh_parts.h>
#include <mesh/soup.h>
#include <mesh/weld_points.h>

#include "changing_boxes.h"

namespace meshrepair::internal {

// Of a collapse: what changes.
struct Collapse {
  std::uint32_t from = 0, to = 0;  // the point that goes, and the one that it becomes
  Vec3d place = Vec3d::Zero();     // of that one
  // The triangles that stay and change, each with its two other corners, and those that go.
  struct FanTriangle {
    std::uint32_t triangle, next, last;
    bool was_of_to;  // else of `from`
  };
  std::vector<FanTriangle> fan;
  std::array<std::uint32_t, 2> gone{};
};

enum class Refusal { none, topology, fold, meeting, distance };

class CollapseGuard {
 public:
  // Mesh and points have to stay, and change as collapses are made; `parts` are those at first.
  // Coordinates are about 1: products of three neither overflow nor vanish.
  CollapseGuard(const CollapsibleMesh& mesh, const std::vector<Vec3d>& points, MeshParts parts);

  // It shares its place with others, and must not be moved.
  [[nodiscard]] bool is_held(std::uint32_t point) const { return places_.is_copy[point] != 0; }

  [[nodiscard]] Refusal refusal(const Collapse& collapse);
  // After the collapse that was asked about last has been made, and its point moved.
  void note_made(const Collapse& collapse);

 private:
  [[nodiscard]] const Vec3d& old_place(const Collapse& collapse,
                                       const Collapse::FanTriangle& t) const {
    return points_[t.was_of_to ? collapse.to : collapse.from];
  }
  [[nodiscard]] bool folds(const Collapse& collapse);
  [[nodiscard]] bool is_height_field(const Collapse& collapse) const;
  [[nodiscard]] bool fan_meets_itself() const;
  [[nodiscard]] bool swallows_rest(const Collapse& collapse);
  [[nodiscard]] bool meets_others(const Collapse& collapse);
  [[nodiscard]] bool meets_fan(std::uint32_t triangle);
  [[nodiscard]] bool fan_touches_itself(const Collapse& collapse) const;
  [[nodiscard]] bool touches_fan(std::uint32_t triangle, const Collapse& collapse) const;
  [[nodiscard]] Box box_of(std::uint32_t triangle) const;
  void rebuild();

  const CollapsibleMesh& mesh_;
  const std::vector<Vec3d>& points_;
  PointPlaces places_;
  std::vector<std::uint32_t> part_of_;     // of each triangle
  std::vector<std::uint32_t> some_point_;  // of each part
  std::vector<double> volume_;             // of each part, six times
  double swept_ = 0;                       // what the collapse that was asked about adds
  ChangingBoxes boxes_;
  std::vector<std::uint32_t> looked_at_by_;  // of each triangle, its last question
  std::uint32_t question_ = 0;
  // The new fan.
  std::vector<CornerTriangle> fan_;
  std::vector<Box> fan_boxes_;
};

}  // namespace meshrepair::internal
