// SPDX-License-Identifier: MIT
// Corners, edges and faces that are near each other come to have the same corners.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <check/near_faces.h>
#include <mesh/edge_table.h>
#include <mesh/soup.h>

#include "near_mesh.h"

namespace meshrepair::internal {

class NearParts {
 public:
  // `pairs` are those that are to lie on each other, no farther apart than the gap. Corners beside
  // them that belong together may be as far apart as the distance along each axis. All have to live
  // as long.
  NearParts(const TriangleSoup& soup, std::span<const NearFaces> pairs, double gap, double distance,
            CancelCheck& check);

  // Until nothing is near another without having its points.
  [[nodiscard]] const NearMesh& bring_together();

 private:
  struct Merge;

  void list_edges();
  [[nodiscard]] std::vector<std::uint32_t> near_points() const;
  void rename(const std::vector<std::uint32_t>& name);
  [[nodiscard]] bool merge_points();
  [[nodiscard]] bool put_on_edges();
  [[nodiscard]] bool put_on_faces();
  [[nodiscard]] bool put_on_face(std::uint32_t point, std::uint32_t triangle);
  [[nodiscard]] bool cross_edges();
  void put(std::uint32_t point, const Vec3d& place);
  [[nodiscard]] std::vector<std::uint32_t> points_of(std::uint32_t triangle) const;

  std::span<const NearFaces> pairs_;
  double radius_;
  CancelCheck& check_;
  NearMesh mesh_;
  std::vector<char> is_placed_;  // of each point: it came to lie on what it was near
};

}  // namespace meshrepair::internal
