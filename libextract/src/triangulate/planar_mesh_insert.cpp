// SPDX-License-Identifier: MIT
// Adding vertices and edges to a planar triangulation.
//
// A vertex splits the triangle or the edge that it lies in. An edge is made by flipping those that
// it crosses, as long as their two triangles are a convex quadrangle (Sloan 1993): each flip that
// leaves an edge crossing is tried again later, and there always is one that helps.
#include <algorithm>

#include <exact/predicates.h>

#include "planar_mesh.h"

namespace meshrepair::internal {
// Visits the slots that start at a vertex until one is wanted no more.
template <class Visit>
void PlanarMesh::for_each_slot_at(std::uint32_t vertex, Visit visit) const {
  const std::uint32_t start = slot_at_[vertex];
  std::uint32_t slot = start;
  while (true) {  // counter-clockwise
    if (!visit(slot)) return;
    slot = across_[previous_slot(slot)];
    if (slot == start) return;
    if (slot == kNone) break;
  }
  for (slot = across_[start]; slot != kNone; slot = across_[slot]) {  // clockwise
    slot = next_slot(slot);
    if (!visit(slot)) return;
  }
}

bool PlanarMesh::insert_vertex(const Point& point, std::uint32_t& vertex) {
  std::uint32_t t = kNone;
  std::array<int, 3> turns{};
  if (!find_triangle(point, t, turns)) return false;
  const auto zeros = std::count(turns.begin(), turns.end(), 0);
  if (zeros > 1) return false;
  vertex = add_vertex(point);
  queue_.clear();
  if (zeros == 0) {
    split_triangle(t, vertex);
  } else {
    const auto k = std::find(turns.begin(), turns.end(), 0) - turns.begin();
    split_side(3 * t + static_cast<std::uint32_t>(k), vertex);
  }
  flip_while_better();
  return true;
}

std::uint32_t PlanarMesh::split_outline(std::uint32_t slot, const Point& point) {
  const std::uint32_t vertex = add_vertex(point);
  split_side(slot, vertex);
  flip_while_better();
  return vertex;
}

std::uint32_t PlanarMesh::outline_from(std::uint32_t vertex) const {
  std::uint32_t found = kNone;
  for_each_slot_at(vertex, [&](std::uint32_t slot) {
    if (across_[slot] == kNone) found = slot;
    return found == kNone;
  });
  return found;
}

// The turns from each side to the point; false if it is outside.
bool PlanarMesh::look_into(std::uint32_t triangle, const Point& point,
                           std::array<int, 3>& turns) const {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t slot = 3 * triangle + k;
    turns[k] = orientation_ * turn(*points_[corners_[slot]], *points_[corners_[next_slot(slot)]],
                                   point, plane_, planes_);
    if (turns[k] < 0) return false;
  }
  return true;
}

// Walks towards the point from the newest triangle. Where angles were rounded the walk might go in
// circles; then all are looked into.
bool PlanarMesh::find_triangle(const Point& point, std::uint32_t& triangle,
                               std::array<int, 3>& turns) const {
  const auto triangles = static_cast<std::uint32_t>(corners_.size() / 3);
  triangle = triangles - 1;
  for (std::uint32_t steps = 0; steps < triangles + 8; ++steps) {
    if (look_into(triangle, point, turns)) return true;
    const auto k = std::find(turns.begin(), turns.end(), -1) - turns.begin();
    const std::uint32_t beyond = across_[3 * triangle + static_cast<std::uint32_t>(k)];
    if (beyond == kNone) break;
    triangle = beyond / 3;
  }
  for (triangle = 0; triangle < triangles; ++triangle) {
    if (look_into(triangle, point, turns)) return true;
  }
  return false;
}

void PlanarMesh::set_triangle(std::uint32_t triangle, const std::array<std::uint32_t, 3>& vertices,
                              const std::array<Beyond, 3>& beyond) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t slot = 3 * triangle + k;
    corners_[slot] = vertices[k];
    slot_at_[vertices[k]] = slot;
    across_[slot] = beyond[k].slot;
    mark_[slot] = beyond[k].mark;
    if (beyond[k].slot != kNone) across_[beyond[k].slot] = slot;
  }
}

// a b c becomes a b v, b c v, c a v.
void PlanarMesh::split_triangle(std::uint32_t triangle, std::uint32_t vertex) {
  std::array<std::uint32_t, 3> corner{};
  std::array<Beyond, 3> outside{};
  for (std::uint32_t k = 0; k < 3; ++k) {
    corner[k] = corners_[3 * triangle + k];
    outside[k] = beyond(3 * triangle + k);
  }
  const std::uint32_t second = add_triangle({corner[1], corner[2], vertex});
  const std::uint32_t third = add_triangle({corner[2], corner[0], vertex});
  set_triangle(triangle, {corner[0], corner[1], vertex},
               {outside[0], Beyond{3 * second + 2, kNone}, Beyond{3 * third + 1, kNone}});
  set_triangle(second, {corner[1], corner[2], vertex},
               {outside[1], Beyond{3 * third + 2, kNone}, Beyond{3 * triangle + 1, kNone}});
  set_triangle(third, {corner[2], corner[0], vertex},
               {outside[2], Beyond{3 * triangle + 2, kNone}, Beyond{3 * second + 1, kNone}});
  queue_ = {3 * triangle, 3 * second, 3 * third};
}

// The side a b of a b c: a v c and v b c. Beyond, b a d becomes v a d and b v d.
void PlanarMesh::split_side(std::uint32_t slot, std::uint32_t vertex) {
  const std::uint32_t mark = mark_[slot], other = across_[slot];
  const std::uint32_t a = corners_[slot], b = corners_[next_slot(slot)];
  const std::uint32_t c = corners_[previous_slot(slot)];
  const Beyond bc = beyond(next_slot(slot)), ca = beyond(previous_slot(slot));
  const std::uint32_t t = slot / 3;
  const std::uint32_t far = add_triangle({vertex, b, c});
  set_triangle(t, {a, vertex, c}, {Beyond{kNone, mark}, Beyond{3 * far + 2, kNone}, ca});
  set_triangle(far, {vertex, b, c}, {Beyond{kNone, mark}, bc, Beyond{3 * t + 1, kNone}});
  queue_ = {3 * t + 2, 3 * far + 1};
  if (other == kNone) return;
  const std::uint32_t d = corners_[previous_slot(other)];
  const Beyond ad = beyond(next_slot(other)), db = beyond(previous_slot(other));
  const std::uint32_t o = other / 3;
  const std::uint32_t near_b = add_triangle({b, vertex, d});
  set_triangle(o, {vertex, a, d}, {Beyond{3 * t, mark}, ad, Beyond{3 * near_b + 1, kNone}});
  set_triangle(near_b, {b, vertex, d}, {Beyond{3 * far, mark}, Beyond{3 * o + 2, kNone}, db});
  queue_.push_back(3 * o + 1);
  queue_.push_back(3 * near_b + 2);
}

// kNone if there is none; of an edge of the outline the slot may start at either end.
std::uint32_t PlanarMesh::slot_between(std::uint32_t from, std::uint32_t to) const {
  std::uint32_t found = kNone;
  for_each_slot_at(from, [&](std::uint32_t slot) {
    if (corners_[next_slot(slot)] == to) {
      found = slot;
    } else if (corners_[previous_slot(slot)] == to) {
      found = previous_slot(slot);
    }
    return found == kNone;
  });
  return found;
}

bool PlanarMesh::list_crossed(std::uint32_t from, std::uint32_t to) {
  std::uint32_t slot = kNone;
  bool blocked = false;
  for_each_slot_at(from, [&](std::uint32_t s) {
    const int right = turn_of(from, to, corners_[next_slot(s)]);
    const int left = turn_of(from, to, corners_[previous_slot(s)]);
    if (right >= 0 || left <= 0) return true;
    slot = next_slot(s);
    return false;
  });
  crossed_.clear();
  while (slot != kNone && !blocked) {
    crossed_.push_back({corners_[slot], corners_[next_slot(slot)]});
    blocked = across_[slot] == kNone || mark_[slot] != kNone;
    if (blocked) break;
    const std::uint32_t beyond = across_[slot];
    const std::uint32_t tip = corners_[previous_slot(beyond)];
    if (tip == to) return true;
    const int side = turn_of(from, to, tip);
    blocked = side == 0;
    // The side between the tip and the corner on the other side of the way.
    slot = side > 0 ? next_slot(beyond) : previous_slot(beyond);
  }
  return false;
}

bool PlanarMesh::insert_edge(std::uint32_t from, std::uint32_t to, std::uint32_t mark) {
  std::uint32_t slot = slot_between(from, to);
  if (slot == kNone) {
    if (!list_crossed(from, to)) return false;
    std::size_t most = 4 * crossed_.size() * crossed_.size() + 16;
    for (std::size_t i = 0; i < crossed_.size() && most > 0; ++i, --most) {
      const auto [u, v] = crossed_[i];
      const std::uint32_t edge = slot_between(u, v);
      if (edge == kNone) return false;
      const std::uint32_t other = across_[edge];
      const std::uint32_t a = corners_[edge], b = corners_[other];
      const std::uint32_t c = corners_[previous_slot(edge)], d = corners_[previous_slot(other)];
      if (turn_of(a, d, c) <= 0 || turn_of(d, b, c) <= 0) {
        crossed_.push_back({u, v});
        continue;
      }
      flip(edge);
      const bool at_end = c == from || c == to || d == from || d == to;
      if (!at_end && turn_of(from, to, c) * turn_of(from, to, d) < 0) crossed_.push_back({c, d});
    }
    slot = slot_between(from, to);
    if (slot == kNone) return false;
  }
  mark_[slot] = mark;
  if (across_[slot] != kNone) mark_[across_[slot]] = mark;
  return true;
}

}  // namespace meshrepair::internal
