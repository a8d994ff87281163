// SPDX-License-Identifier: MIT
// Open edges that lie near a corner, but are not its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <check/box_tree.h>
#include <mesh/soup.h>

#include "open_rims.h"

namespace meshrepair::internal {

// Where a segment is nearest to a point.
struct NearestOnEdge {
  double squared_distance = 0;
  double share = 0;  // of the way from its first end to its second
};

[[nodiscard]] NearestOnEdge nearest_on_edge(const Vec3d& p, const Vec3d& a, const Vec3d& b);

class Strangers {
 public:
  // Both have to live as long.
  Strangers(const TriangleSoup& soup, const OpenRims& rims);

  // Calls visit(side, nearest) for open edges within the distance of a corner that do not end
  // there, and whose triangle has no corner there.
  template <class Visit>
  void visit(std::uint32_t corner, double distance, Visit visit_edge) const {
    const Vec3d& p = soup_.points[corner];
    Box around;
    around.add(p);
    around.widen(distance);
    tree_.visit([&](const Box& box) { return box.meets(around); },
                [&](std::uint32_t i) {
                  const std::uint32_t side = rims_.sides[i];
                  if (!boxes_[i].meets(around) || is_of(side / 3, corner)) return;
                  const auto [a, b] = ends_of(rims_, side);
                  const NearestOnEdge found = nearest_on_edge(p, soup_.points[a], soup_.points[b]);
                  if (found.squared_distance <= distance * distance) visit_edge(side, found);
                });
  }

 private:
  [[nodiscard]] bool is_of(std::uint32_t triangle, std::uint32_t corner) const {
    const IndexTriangle& t = rims_.triangles[triangle];
    return t[0] == corner || t[1] == corner || t[2] == corner;
  }

  const TriangleSoup& soup_;
  const OpenRims& rims_;
  std::vector<Box> boxes_;  // of the open edges
  BoxTree tree_;
};

// How far each of rims.corners is from the nearest such edge; infinite where it is not nearer than
// this share of the edges at the corner. `progress` (may be null) is asked whether to go on: where
// triangles lie in a heap, each corner has thousands of such edges.
[[nodiscard]] std::vector<double> distances_of_strangers(const Strangers& strangers,
                                                         const OpenRims& rims, double share,
                                                         ProgressObserver* progress);

}  // namespace meshrepair::internal
