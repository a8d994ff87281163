// SPDX-License-Identifier: MIT
#include "simplify_surface.h"

#include <cstdint>

#include <Eigen/Geometry>

#include <base/roots.h>

namespace meshrepair::internal {

void Simplifier::keep_points_of(const Surface& surface, const std::vector<char>& whole) {
  stays_.assign(surface.mesh.points.size(), 0);
  for (std::size_t t = 0; t < whole.size(); ++t) {
    if (whole[t] == 0) continue;
    for (const std::uint32_t p : surface.mesh.triangles[t]) stays_[p] = 1;
  }
}

std::optional<Surface> Simplifier::simplified(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const Vec3d& p : surface.mesh.points) box.extend(p);
  SimplifyOptions simplify_options;
  simplify_options.within = options_.simplify * stable_length(box.max() - box.min());
  simplify_options.reach = options_.reach;
  simplify_options.progress = options_.progress;
  const SimplifyReport before = report_;
  std::optional<Surface> simpler = simplify_cuts(surface, stays_, simplify_options, report_);
  report_.rounds += before.rounds;
  report_.points_to_stay += before.points_to_stay;
  return simpler;
}

}  // namespace meshrepair::internal
