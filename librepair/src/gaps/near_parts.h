// Corners, edges and faces that are near each other come to have the same corners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <check/near_faces.h>
#include <mesh/edge_table.h>
#include <mesh/soup.h>
#include <repair/join_gaps.h>

#include "face_pieces.h"

namespace meshrepair::internal {

class NearParts {
 public:
  // `pairs` are those that are to lie on each other, no farther apart than the gap. Corners beside
  // them that belong together may be as far apart as the distance along each axis. All have to live
  // as long.
  NearParts(const TriangleSoup& soup, std::span<const NearFaces> pairs, double gap, double distance,
            CancelCheck& check);

  // Until nothing is near another without having its points.
  void bring_together();

  [[nodiscard]] JoinedSoup cut(JoinGapsReport& report);

 private:
  // An edge of a triangle of a pair, as it was given, and the points that came to lie on it.
  struct Edge {
    EdgeEnds ends;
    std::vector<std::uint32_t> inner;
  };
  struct Merge;

  void list_edges();
  [[nodiscard]] std::vector<std::uint32_t> near_points() const;
  [[nodiscard]] std::uint32_t edge_between(std::uint32_t a, std::uint32_t b) const;
  void rename(const std::vector<std::uint32_t>& name);
  [[nodiscard]] bool merge_points();
  [[nodiscard]] bool put_on_edges();
  [[nodiscard]] bool put_on_faces();
  [[nodiscard]] bool put_on_face(std::uint32_t point, std::uint32_t triangle);
  [[nodiscard]] bool cross_edges();
  void put(std::uint32_t point, const Vec3d& place);
  [[nodiscard]] std::vector<std::uint32_t> points_of(std::uint32_t triangle) const;
  [[nodiscard]] std::vector<std::uint32_t> along(std::uint32_t from, std::uint32_t to) const;
  [[nodiscard]] std::vector<std::vector<EdgeEnds>> edges_inside(
      const std::vector<std::vector<std::uint32_t>>& outlines) const;

  const TriangleSoup& soup_;
  std::span<const NearFaces> pairs_;
  double radius_;
  CancelCheck& check_;
  std::vector<Vec3d> at_;                          // of each point, also new ones
  std::vector<char> is_placed_;                    // it came to lie on what it was near
  std::vector<std::uint32_t> name_;                // of each point of the soup: the one it is now
  std::vector<IndexTriangle> corners_;             // of each triangle
  std::vector<Edge> edges_;                        // sorted by their ends
  std::vector<std::vector<std::uint32_t>> inner_;  // of each triangle: points in it, ascending
};

}  // namespace meshrepair::internal
