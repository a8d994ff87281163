// SPDX-License-Identifier: MIT
// A closed mesh whose points can be moved onto neighbours, one after the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meshrepair::internal {

// Triangle i is (point, link[i], link[i + 1]), after the last the first again.
struct PointStar {
  std::uint32_t point = 0;
  std::vector<std::uint32_t> link, triangles;

  [[nodiscard]] std::size_t before(std::size_t i) const { return i == 0 ? link.size() - 1 : i - 1; }
  [[nodiscard]] std::size_t after(std::size_t i) const { return i + 1 == link.size() ? 0 : i + 1; }
};

// Has the triangles of a closed manifold mesh, and stays one. Of each point it keeps the list of
// its corners; corner 3 t + k is corner k of triangle t.
class CollapsibleMesh {
 public:
  // Stars of more triangles are left alone, and so are those with a neighbour of many more: to look
  // through all of that one's for every collapse beside would be quadratic.
  static constexpr std::size_t kMostOfStar = 32;
  static constexpr std::size_t kMostOfNeighbour = 4096;

  CollapsibleMesh(std::vector<std::array<std::uint32_t, 3>> triangles, std::size_t points);

  [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const {
    return triangles_;
  }
  [[nodiscard]] bool is_left(std::uint32_t triangle) const { return left_[triangle] != 0; }
  // Triangles of the point.
  [[nodiscard]] std::uint32_t degree(std::uint32_t point) const { return degree_[point]; }

  // False for a point that has no triangles any more, or too many, or such a neighbour.
  [[nodiscard]] bool find_star(std::uint32_t point, PointStar& star);

  // Whether the mesh stays a closed manifold, of the same genus, when the star's point is moved
  // onto link[to]: if the two points have only those two neighbours in common that both have to
  // have, and no neighbour is left with two triangles.
  [[nodiscard]] bool may_collapse(const PointStar& star, std::size_t to);

  // The star has to be as find_star() gives it now. Its triangles before `to` and at `to` go.
  void collapse(const PointStar& star, std::size_t to);

  // The inverse: `triangles` are those of the star, and all of them, and of the target's, have to
  // be as collapse() left them.
  void restore(std::uint32_t point, std::uint32_t target, std::span<const std::uint32_t> triangles);

  // Calls visit(triangle, next corner, the one after) for each triangle of the point.
  template <class Visit>
  void visit_corners(std::uint32_t point, const Visit& visit) {
    std::uint32_t before = kNone;
    for (std::uint32_t corner = first_[point]; corner != kNone; corner = next_[corner]) {
      const std::uint32_t t = corner / 3, k = corner % 3;
      // Corners of triangles that are gone leave the list on the way.
      if (left_[t] == 0) continue;
      (before == kNone ? first_[point] : next_[before]) = corner;
      before = corner;
      visit(t, triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3]);
    }
    (before == kNone ? first_[point] : next_[before]) = kNone;
    last_[point] = before;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  void append(std::uint32_t point, std::uint32_t corner);
  void drop_gone(std::uint32_t point);

  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<char> left_;
  std::vector<std::uint32_t> next_;          // of each corner, in the list of its point
  std::vector<std::uint32_t> first_, last_;  // of each point
  std::vector<std::uint32_t> degree_;        // triangles of each point
  std::vector<std::uint32_t> marked_by_;     // of each point, the last star it was a neighbour of
  std::uint32_t mark_ = 0;
};

}  // namespace meshrepair::internal
