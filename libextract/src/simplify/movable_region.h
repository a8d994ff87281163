// SPDX-License-Identifier: MIT
// What moving points of a mesh can change, and what has to be looked at for it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::internal {

// A mesh of its own: the triangles of all points that may move, and all triangles of their
// neighbours. Numbers of points and triangles are in the order of those in the whole mesh. Mostly
// it is a small part, so its arrays are near each other in memory.
class MovableRegion {
 public:
  // `stays` and `within` are of each point, `source` is of each triangle or empty.
  MovableRegion(const TriangleSoup& whole, const std::vector<char>& stays,
                const std::vector<double>& within, std::span<const std::uint32_t> source);

  [[nodiscard]] const TriangleSoup& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<double>& within() const { return within_; }
  [[nodiscard]] const std::vector<std::uint32_t>& source() const { return source_; }

  // Points may be told to stay later.
  [[nodiscard]] const std::vector<char>& stays() const { return stays_; }
  void stay(std::uint32_t point) { stays_[point] = 1; }
  void copy_stays(std::vector<char>& stays_of_whole) const;

  // Of each triangle here, its number in the whole mesh, in rising order.
  [[nodiscard]] const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  // Of each point.
  [[nodiscard]] const std::vector<std::uint32_t>& points() const { return points_; }
  // The number here of a triangle of the whole mesh; empty if it is outside.
  [[nodiscard]] std::optional<std::uint32_t> find(std::uint32_t triangle_of_whole) const;

 private:
  TriangleSoup mesh_;
  std::vector<std::uint32_t> triangles_, points_;
  std::vector<char> stays_;
  std::vector<double> within_;
  std::vector<std::uint32_t> source_;
};

}  // namespace meshrepair::internal
