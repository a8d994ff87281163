// SPDX-License-Identifier: MIT
// A closed mesh that is changed in few places: edges collapsed and flipped.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/ids.h>

namespace meshrepair::internal {

using TriangleCorners = std::array<std::uint32_t, 3>;

inline constexpr TriangleCorners kGone{kNone, kNone, kNone};

// What some triangles become; kGone: they go. Numbers beyond those that are there are new ones.
struct MeshEdit {
  std::vector<std::uint32_t> triangles;
  std::vector<TriangleCorners> now;
};

// Has the triangles of a closed manifold mesh, and stays one. Edits are found first, and may then
// be applied as long as no other one was.
class EditableMesh {
 public:
  EditableMesh(std::vector<TriangleCorners> triangles, std::size_t points);

  [[nodiscard]] const std::vector<TriangleCorners>& triangles() const { return triangles_; }
  [[nodiscard]] bool is_left(std::uint32_t triangle) const { return triangles_[triangle] != kGone; }
  // Until the next edit is applied.
  [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::uint32_t point) const {
    if (const std::uint32_t list = list_of_[point]; list != kNone) return lists_[list];
    return {around_.data() + first_[point], around_.data() + first_[point + 1]};
  }

  // The point's neighbours in the order in which the triangles around it pass them. False for a
  // point that has none any more, or very many, or is not inside one fan of triangles.
  [[nodiscard]] bool find_link(std::uint32_t point, std::vector<std::uint32_t>& link) const;

  // Moves the point onto a neighbour. False where the mesh would not stay manifold, of the same
  // genus.
  [[nodiscard]] bool find_collapse(std::uint32_t point, std::uint32_t onto, MeshEdit& edit) const;

  // Turns the edge from corner k of the triangle. The first of the new triangles has the new edge
  // from its corner 0. False where that edge is there already.
  [[nodiscard]] bool find_flip(std::uint32_t triangle, std::size_t k, MeshEdit& edit) const;

  void apply(const MeshEdit& edit);

 private:
  std::vector<std::uint32_t>& changed_list(std::uint32_t point);

  std::vector<TriangleCorners> triangles_;
  // Of each point its triangles at first, from around_[first_[p]] on. Lists of their own would be
  // so many small objects as a large mesh has points.
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> around_;
  // Of those where edits were made, as they are now.
  std::vector<std::uint32_t> list_of_;  // kNone: no edit was made
  std::vector<std::vector<std::uint32_t>> lists_;
};

}  // namespace meshrepair::internal
