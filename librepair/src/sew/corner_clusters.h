// SPDX-License-Identifier: MIT
// Corners that become one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

#include "open_rims.h"

namespace meshrepair::internal {

class CornerClusters {
 public:
  // Each corner is a cluster of its own.
  CornerClusters(const TriangleSoup& soup, const OpenRims& rims);

  // Joins clusters of corners no farther apart than the distance and than `share` of the edges at
  // both, nearest first, where the cluster is not wider than twice the distance and has no two
  // corners of one triangle; with an infinite share, none that are farther apart than the distance.
  // False, and nothing is joined, where so many are near each other that they cannot be told apart.
  [[nodiscard]] bool join(double distance, double share, CancelCheck& check);

  // The first corner of its cluster; of a point that is no corner itself.
  [[nodiscard]] std::uint32_t of(std::uint32_t point) const { return cluster_[point]; }

  // Between two corners that brought their clusters together: 0 where all are alone.
  [[nodiscard]] double widest_gap() const;

  // Corners of one cluster are clusters of their own again.
  void dissolve(const std::vector<char>& is_dissolved);

  // Of each point of the soup: where its cluster has its middle, and itself where it is alone.
  [[nodiscard]] std::vector<Vec3d> middles() const;

 private:
  struct Pair {
    double squared_distance;
    std::uint32_t a, b;
  };

  [[nodiscard]] std::optional<std::vector<Pair>> pairs_within(double distance, double share,
                                                              CancelCheck& check) const;
  [[nodiscard]] bool may_join(std::uint32_t a, std::uint32_t b, double width, double narrow) const;
  [[nodiscard]] bool share_a_triangle(std::uint32_t a, std::uint32_t b) const;

  const TriangleSoup& soup_;
  const OpenRims& rims_;
  std::vector<std::uint32_t> cluster_;                       // of each point
  std::vector<std::vector<std::uint32_t>> members_;          // of each cluster, by its first corner
  std::vector<Pair> joined_;                                 // also those that are dissolved
  std::vector<std::uint32_t> first_triangle_, triangle_of_;  // at each point
};

}  // namespace meshrepair::internal
