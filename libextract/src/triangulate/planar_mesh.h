// SPDX-License-Identifier: MIT
// A triangulated region of a plane to which vertices and edges can be added, and from which
// vertices can be taken away, exactly.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <exact/plane_table.h>
#include <exact/point.h>

namespace meshrepair::internal {

// Of the same triangle.
[[nodiscard]] inline std::uint32_t next_slot(std::uint32_t slot) {
  return slot % 3 == 2 ? slot - 2 : slot + 1;
}
[[nodiscard]] inline std::uint32_t previous_slot(std::uint32_t slot) {
  return slot % 3 == 0 ? slot + 2 : slot - 1;
}

// Triangles are counter-clockwise in the region's own sense. Slot 3 t + k is the side of triangle t
// from its corner k to corner k + 1. The region may have holes and touch itself at vertices: a
// vertex that it touches itself at is there several times.
class PlanarMesh {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  // `loose`: the triangles are those of a loose complex, where two of them may have two edges in
  // common, or one with itself.
  PlanarMesh(const PlaneTable& planes, bool loose) : planes_(planes), loose_(loose) {}

  // Starts anew. `orientation` is +1 when counter-clockwise is as seen from where the plane's
  // normal points, -1 when from behind.
  void reset(PlaneId plane, int orientation);
  // The point must stay where it is while it is in use.
  std::uint32_t add_vertex(const Point& point);
  std::uint32_t add_triangle(const std::array<std::uint32_t, 3>& vertices);
  // The two slots are the same edge, passed in opposite directions.
  void join(std::uint32_t slot, std::uint32_t other);
  // Marks a slot on the outline, or both slots of an edge that is to stay; kNone is no mark.
  void mark(std::uint32_t slot, std::uint32_t mark) { mark_[slot] = mark; }

  // Adds a vertex inside the region, or on an edge, whose parts then both have its mark. False
  // where there is one already, or no region. Flips edges without a mark so that few long ones
  // stay.
  [[nodiscard]] bool insert_vertex(const Point& point, std::uint32_t& vertex);
  // The same on a slot of the outline, without looking where the point is.
  [[nodiscard]] std::uint32_t split_outline(std::uint32_t slot, const Point& point);
  // The slot of the outline that starts at a vertex; kNone if there is none.
  [[nodiscard]] std::uint32_t outline_from(std::uint32_t vertex) const;
  // Flips edges until the two are connected by one, and marks its slots. False where a vertex, the
  // outline or an edge with a mark is in between.
  [[nodiscard]] bool insert_edge(std::uint32_t from, std::uint32_t to, std::uint32_t mark);

  // Takes away a vertex that is inside the region, or inside a straight part of its outline, and
  // fills the star around it again. The new side of the outline, if any, carries no mark. False
  // where that cannot be, which leaves the mesh of no use; never so with exact points.
  [[nodiscard]] bool remove_vertex(std::uint32_t vertex);

  // Flips edges without a mark until the triangulation is constrained Delaunay as far as rounded
  // angles tell. Every triangle stays proper.
  void improve();

  // Slots of all triangles, those that were taken away, too, whose slots start at no vertex.
  [[nodiscard]] std::uint32_t slots() const { return static_cast<std::uint32_t>(corners_.size()); }
  [[nodiscard]] std::uint32_t vertex_at(std::uint32_t slot) const { return corners_[slot]; }
  [[nodiscard]] std::uint32_t across(std::uint32_t slot) const { return across_[slot]; }
  [[nodiscard]] std::uint32_t mark_of(std::uint32_t slot) const { return mark_[slot]; }

  // Calls visit(vertices, marks), two arrays of three, for each triangle.
  template <class Visit>
  void for_each_triangle(Visit visit) const {
    for (std::uint32_t t = 0; t < corners_.size() / 3; ++t) {
      if (corners_[3 * t] == kNone) continue;
      visit(std::array{corners_[3 * t], corners_[3 * t + 1], corners_[3 * t + 2]},
            std::array{mark_[3 * t], mark_[3 * t + 1], mark_[3 * t + 2]});
    }
  }

 private:
  // What lies beyond a side: the slot of the neighbour, or the outline with its mark.
  struct Beyond {
    std::uint32_t slot = kNone;
    std::uint32_t mark = kNone;
  };
  struct LinkVertex {
    std::uint32_t vertex = kNone;
    Beyond beyond;  // the side from this vertex to the next
    std::uint32_t previous = 0, next = 0;
  };

  void gather_star(std::uint32_t vertex);
  [[nodiscard]] bool star_is_disk() const;
  [[nodiscard]] bool fill_star(std::uint32_t vertex);
  [[nodiscard]] bool is_ear(std::uint32_t vertex, std::uint32_t at) const;
  std::uint32_t place_triangle(const std::array<std::uint32_t, 3>& vertices,
                               const std::array<Beyond, 3>& beyond);
  [[nodiscard]] int turn_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] bool wants_flip(std::uint32_t slot) const;
  [[nodiscard]] bool can_flip(std::uint32_t slot) const;
  void flip(std::uint32_t slot);
  void flip_while_better();
  [[nodiscard]] bool find_triangle(const Point& point, std::uint32_t& triangle,
                                   std::array<int, 3>& turns) const;
  [[nodiscard]] bool look_into(std::uint32_t triangle, const Point& point,
                               std::array<int, 3>& turns) const;
  void split_triangle(std::uint32_t triangle, std::uint32_t vertex);
  void split_side(std::uint32_t slot, std::uint32_t vertex);
  void set_triangle(std::uint32_t triangle, const std::array<std::uint32_t, 3>& vertices,
                    const std::array<Beyond, 3>& beyond);
  template <class Visit>
  void for_each_slot_at(std::uint32_t vertex, Visit visit) const;
  [[nodiscard]] std::uint32_t slot_between(std::uint32_t from, std::uint32_t to) const;
  [[nodiscard]] bool list_crossed(std::uint32_t from, std::uint32_t to);
  [[nodiscard]] Beyond beyond(std::uint32_t slot) const { return {across_[slot], mark_[slot]}; }

  const PlaneTable& planes_;
  bool loose_;
  PlaneId plane_;
  int orientation_ = 1;
  std::vector<const Point*> points_;
  std::vector<std::uint32_t> slot_at_;  // of each vertex a slot that starts there
  std::vector<std::uint32_t> corners_;  // of each slot the vertex that it starts at
  std::vector<std::uint32_t> across_;
  std::vector<std::uint32_t> mark_;
  // Scratch of one removal.
  std::vector<LinkVertex> link_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> queue_;
  std::vector<std::array<std::uint32_t, 2>> crossed_;  // edges, by their vertices
};

}  // namespace meshrepair::internal
