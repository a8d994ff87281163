// SPDX-License-Identifier: MIT
// Which triangles meet at which edge.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace meshrepair {

using IndexTriangle = std::array<std::uint32_t, 3>;

// All edges of a list of triangles, sorted by their end points, each with the triangles' sides that
// run along it. Side 3 t + k of triangle t runs from its corner k to corner k + 1. Linear in the
// triangles and the largest index, but for points at which many edges meet. Throws LimitError
// beyond kMostTriangles.
class EdgeTable {
 public:
  // Sides with an entry in `across` other than all ones are left out; none are if it is empty.
  explicit EdgeTable(std::span<const IndexTriangle> triangles,
                     std::span<const std::uint32_t> across = {});

  // Calls visit(std::span<const std::uint32_t> sides) for each edge, the sides in ascending order.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (std::size_t edge = 0; edge < edges(); ++edge) visit(sides(edge));
  }
  [[nodiscard]] std::size_t edges() const { return first_.size() - 1; }
  // Ascending.
  [[nodiscard]] std::span<const std::uint32_t> sides(std::size_t edge) const {
    return {sides_.data() + first_[edge], first_[edge + 1] - first_[edge]};
  }
  // The sides of all edges, one after the other, and where those of each edge begin, and end. The
  // table is empty then.
  [[nodiscard]] std::vector<std::uint32_t> take_sides() { return std::move(sides_); }
  [[nodiscard]] std::vector<std::uint32_t> take_first() { return std::move(first_); }

 private:
  std::vector<std::uint32_t> sides_;
  std::vector<std::uint32_t> first_;
};

[[nodiscard]] inline std::uint32_t side_start(std::span<const IndexTriangle> triangles,
                                              std::uint32_t side) {
  return triangles[side / 3][side % 3];
}

[[nodiscard]] inline std::uint32_t next_side(std::uint32_t side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}

}  // namespace meshrepair
