// SPDX-License-Identifier: MIT
// Which collapses leave walls as thick as they are to be.
#pragma once

#include <vector>

#include <simplify/decimate.h>

#include "common/depth.h"
#include "common/prove_depth.h"

namespace meshrepair::internal {

// A collapse is allowed if
//
// - nothing of what it takes out of a cavity is deeper than the thickness and the error. That is
//   proven for all of it: what lies between the triangles before and those after is covered by the
//   tetrahedra between the new place and the triangles before;
// - some points of the triangles after are not less deep than the thickness less the error. For
//   the other points, that has to be proven at the end: it takes long, and seldom fails;
// - no fold gets larger: triangles whose outer side is where the distance grows.
class WallJudge : public CollapseJudge {
 public:
  // `points` of walls that are no farther off than that.
  WallJudge(const Depth& depth, const std::vector<Vec3d>& points, double thickness, double error);

  [[nodiscard]] bool allows(const Question& question) override;
  void note_made(const Question& question) override { places_[question.point] = place_; }

 private:
  [[nodiscard]] bool is_deep(const Piece& triangle) const;
  [[nodiscard]] double turned_area(const Piece& triangle) const;

  const Depth& depth_;
  double least_, most_;
  std::vector<Place> places_;  // of points of the walls
  Place place_;                // that was asked about last
};

}  // namespace meshrepair::internal
