// SPDX-License-Identifier: MIT
// Idea: each triangle has two faces, and where triangles meet at an edge, the faces that look at
// each other across the space between two neighbours belong together. In an open box with dividers
// that gives each compartment a surface of its own, and all of them another one, seen from outside.
// The rim of that last one is the opening; the other open edges are in the compartments.
#include "dividers.h"

#include <algorithm>
#include <cstdint>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>

#include "common/edge_fan.h"

namespace meshrepair::internal {
namespace {

// Face 2 t of triangle t looks to where its plane is positive, face 2 t + 1 to the other side.
std::uint32_t front(std::uint32_t side) { return 2 * (side / 3); }
std::uint32_t back(std::uint32_t side) { return front(side) + 1; }

// What the surface of some faces encloses: seen from the middle of its rim, in cubic grid steps.
struct Room {
  Vec3d middle = Vec3d::Zero();
  double rim_edges = 0;
  double volume = 0;
};

class DividerFinder {
 public:
  DividerFinder(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                const EdgeTable& table)
      : soup_(soup), triangles_(triangles), table_(table), parts_(0), faces_(0) {}

  std::vector<char> run() {
    if (!find_parts()) return {};
    join_faces();
    number_rooms();
    measure_rooms();
    return mark();
  }

 private:
  enum Trait : char { open = 1, crowded = 2, unclear = 4 };

  // Whether one is both open and crowded: has an edge of one triangle, and one of more than two.
  bool find_parts() {
    bool any_open = false, any_crowded = false;
    table_.for_each_edge([&](std::span<const std::uint32_t> sides) {
      any_open |= sides.size() == 1;
      any_crowded |= sides.size() > 2;
    });
    if (!any_open || !any_crowded) return false;
    parts_ = DisjointSets(triangles_.size());
    table_.for_each_edge([&](std::span<const std::uint32_t> sides) {
      for (const std::uint32_t side : sides) parts_.join(sides[0] / 3, side / 3);
    });
    traits_.assign(triangles_.size(), 0);
    table_.for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() == 1) traits_[part_of(sides[0])] |= open;
      if (sides.size() > 2) traits_[part_of(sides[0])] |= crowded;
    });
    // Where closed surfaces overlap, a triangle of both has more than two faces.
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (soup_.triangles[TriangleId(t)].layers > 1) traits_[parts_.root(t)] |= unclear;
    }
    return std::any_of(traits_.begin(), traits_.end(),
                       [](char trait) { return trait == (open | crowded); });
  }

  [[nodiscard]] std::uint32_t part_of(std::uint32_t side) { return parts_.root(side / 3); }

  [[nodiscard]] bool may_have_dividers(std::uint32_t side) {
    return traits_[part_of(side)] == (open | crowded);
  }

  void join_faces() {
    faces_ = DisjointSets(2 * triangles_.size());
    std::vector<std::uint32_t> around;
    table_.for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() < 2 || !may_have_dividers(sides[0])) return;
      around.assign(sides.begin(), sides.end());
      if (sides.size() > 2 && !sort_around_edge(soup_, triangles_, around)) {
        traits_[part_of(sides[0])] |= unclear;
        return;
      }
      const std::uint32_t start = side_start(triangles_, around[0]);
      for (std::size_t i = 0; i < around.size(); ++i) {
        const std::uint32_t here = around[i], next = around[(i + 1) % around.size()];
        faces_.join(side_start(triangles_, here) == start ? front(here) : back(here),
                    side_start(triangles_, next) == start ? back(next) : front(next));
      }
    });
  }

  [[nodiscard]] Vec3d corner(std::uint32_t side) const {
    return as_vector(soup_.grid_points[PointId(side_start(triangles_, side))]);
  }

  // There are few of them, and many faces.
  void number_rooms() {
    room_of_.assign(2 * triangles_.size(), 0);
    for (std::uint32_t face = 0; face < room_of_.size(); ++face) {
      if (!may_have_dividers(3 * (face / 2))) continue;
      // The lowest face of a set stands for it, so that its number is there.
      const std::uint32_t root = faces_.root(face);
      if (root == face) rooms_.emplace_back();
      room_of_[face] =
          root == face ? static_cast<std::uint32_t>(rooms_.size() - 1) : room_of_[root];
    }
  }

  void measure_rooms() {
    for_each_open_edge([&](std::uint32_t side) {
      const Vec3d both = corner(side) + corner(next_side(side));
      for (const std::uint32_t face : {front(side), back(side)}) {
        Room& room = rooms_[room_of_[face]];
        room.middle += 0.5 * both;
        room.rim_edges += 1;
      }
    });
    for (Room& room : rooms_) room.middle /= std::max(room.rim_edges, 1.0);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!may_have_dividers(3 * t)) continue;
      for (const std::uint32_t face : {2 * t, 2 * t + 1}) {
        Room& room = rooms_[room_of_[face]];
        const Vec3d a = corner(3 * t) - room.middle, b = corner(3 * t + 1) - room.middle;
        const double volume = a.dot(b.cross(corner(3 * t + 2) - room.middle)) / 6;
        room.volume += face % 2 == 0 ? -volume : volume;
      }
    }
  }

  // Of parts that may have dividers.
  template <class Visit>
  void for_each_open_edge(Visit visit) {
    table_.for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() == 1 && may_have_dividers(sides[0])) visit(sides[0]);
    });
  }

  [[nodiscard]] bool looks_into_room(std::uint32_t face) {
    return rooms_[room_of_[face]].volume > 0;
  }

  [[nodiscard]] bool is_of_divider(std::uint32_t side) {
    return looks_into_room(front(side)) && looks_into_room(back(side));
  }

  std::vector<char> mark() {
    enum : char { rim = 1, divider = 2 };
    std::vector<char> found(triangles_.size(), 0);
    for_each_open_edge([&](std::uint32_t side) {
      const int rooms = int{looks_into_room(front(side))} + int{looks_into_room(back(side))};
      if (rooms == 0) traits_[part_of(side)] |= unclear;
      if (rooms > 0) found[part_of(side)] |= rooms == 1 ? rim : divider;
    });
    std::vector<char> is_marked;
    table_.for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (found[part_of(sides[0])] != (rim | divider) || !may_have_dividers(sides[0])) return;
      if (sides.size() == 2 || (sides.size() == 1 && !is_of_divider(sides[0]))) return;
      is_marked.resize(3 * triangles_.size(), 0);
      for (const std::uint32_t side : sides) is_marked[side] = 1;
    });
    return is_marked;
  }

  const CleanSoup& soup_;
  std::span<const IndexTriangle> triangles_;
  const EdgeTable& table_;
  DisjointSets parts_;        // of triangles
  std::vector<char> traits_;  // of each part
  DisjointSets faces_;
  std::vector<std::uint32_t> room_of_;  // of each face of a part that may have dividers
  std::vector<Room> rooms_;             // of each set of faces
};

}  // namespace

std::vector<char> find_dividers(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                                const EdgeTable& table) {
  return DividerFinder(soup, triangles, table).run();
}

}  // namespace meshrepair::internal
