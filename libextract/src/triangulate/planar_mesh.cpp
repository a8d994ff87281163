// SPDX-License-Identifier: MIT
// Taking vertices out of a planar triangulation.
//
// The triangles around a vertex v fill a polygon P that is star-shaped from v; v is inside it or,
// for a vertex of a straight outline, on the side that closes it. P is filled again ear by ear.
// Corner q between p and r is an ear when p q r turns left and v is not strictly inside it, p r v
// turning left or straight: then the ear lies in the two triangles v p q and v q r, so no other
// vertex is in it and the rest of P is star-shaped from v again. There always is one: a
// triangulation of P has two ears at least, and at most one triangle of it has v inside.
#include "planar_mesh.h"

#include <algorithm>
#include <cmath>

#include <base/assert.h>
#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double length_of_cross(const Vector& a, const Vector& b) {
  const Vector c = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0]};
  return std::sqrt(dot(c, c));
}

}  // namespace

void PlanarMesh::reset(PlaneId plane, int orientation) {
  plane_ = plane;
  orientation_ = orientation;
  points_.clear();
  slot_at_.clear();
  corners_.clear();
  across_.clear();
  mark_.clear();
}

std::uint32_t PlanarMesh::add_vertex(const Point& point) {
  points_.push_back(&point);
  slot_at_.push_back(kNone);
  return static_cast<std::uint32_t>(points_.size() - 1);
}

std::uint32_t PlanarMesh::add_triangle(const std::array<std::uint32_t, 3>& vertices) {
  const auto first = static_cast<std::uint32_t>(corners_.size());
  for (std::uint32_t k = 0; k < 3; ++k) {
    corners_.push_back(vertices[k]);
    across_.push_back(kNone);
    mark_.push_back(kNone);
    slot_at_[vertices[k]] = first + k;
  }
  return first / 3;
}

void PlanarMesh::join(std::uint32_t slot, std::uint32_t other) {
  across_[slot] = other;
  across_[other] = slot;
}

bool PlanarMesh::remove_vertex(std::uint32_t vertex) {
  gather_star(vertex);
  if ((loose_ && !star_is_disk()) || !fill_star(vertex)) return false;
  slot_at_[vertex] = kNone;
  return true;
}

// Lists the polygon around the vertex in link_ and its triangles in free_.
void PlanarMesh::gather_star(std::uint32_t vertex) {
  link_.clear();
  free_.clear();
  const std::uint32_t start = slot_at_[vertex];
  std::uint32_t out = start;
  bool closed = false;
  while (across_[out] != kNone) {  // clockwise to the outline, or once round
    out = next_slot(across_[out]);
    if (out == start) {
      closed = true;
      break;
    }
  }
  for (const std::uint32_t first = out;;) {
    const std::uint32_t opposite = next_slot(out);
    free_.push_back(out / 3);
    link_.push_back({corners_[opposite], beyond(opposite), 0, 0});
    const std::uint32_t in = previous_slot(out);
    if (across_[in] == kNone) {
      link_.push_back({corners_[in], {}, 0, 0});
      break;
    }
    out = across_[in];
    if (closed && out == first) break;
  }
  const auto n = static_cast<std::uint32_t>(link_.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    link_[i].previous = i > 0 ? i - 1 : n - 1;
    link_[i].next = i + 1 < n ? i + 1 : 0;
  }
}

// Whether the triangles around the vertex are different ones and have no edges in common but those
// that lead to it.
bool PlanarMesh::star_is_disk() const {
  std::vector<std::uint32_t> sorted = free_;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return false;
  return std::none_of(link_.begin(), link_.end(), [&](const LinkVertex& v) {
    return v.beyond.slot != kNone &&
           std::binary_search(sorted.begin(), sorted.end(), v.beyond.slot / 3);
  });
}

bool PlanarMesh::fill_star(std::uint32_t vertex) {
  for (const std::uint32_t t : free_) corners_[3 * t] = kNone;
  auto left = static_cast<std::uint32_t>(link_.size());
  if (left < 3) return false;
  std::uint32_t at = 0;
  std::uint32_t refused = 0;
  while (left > 3) {
    if (!is_ear(vertex, at)) {
      if (++refused > left) return false;
      at = link_[at].next;
      continue;
    }
    refused = 0;
    LinkVertex& before = link_[link_[at].previous];
    const LinkVertex& after = link_[link_[at].next];
    const std::uint32_t t = place_triangle({before.vertex, link_[at].vertex, after.vertex},
                                           {before.beyond, link_[at].beyond, Beyond{}});
    before.beyond = {3 * t + 2, kNone};
    before.next = link_[at].next;
    link_[link_[at].next].previous = link_[at].previous;
    at = after.next;  // not the neighbour, or all would become one fan
    --left;
  }
  const LinkVertex& a = link_[at];
  const LinkVertex& b = link_[a.next];
  const LinkVertex& c = link_[b.next];
  place_triangle({a.vertex, b.vertex, c.vertex}, {a.beyond, b.beyond, c.beyond});
  return true;
}

bool PlanarMesh::is_ear(std::uint32_t vertex, std::uint32_t at) const {
  const std::uint32_t before = link_[link_[at].previous].vertex;
  const std::uint32_t after = link_[link_[at].next].vertex;
  return turn_of(before, link_[at].vertex, after) > 0 && turn_of(vertex, before, after) >= 0;
}

std::uint32_t PlanarMesh::place_triangle(const std::array<std::uint32_t, 3>& vertices,
                                         const std::array<Beyond, 3>& beyond) {
  MESHREPAIR_ASSERT(!free_.empty());
  const std::uint32_t t = free_.back();
  free_.pop_back();
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t slot = 3 * t + k;
    corners_[slot] = vertices[k];
    slot_at_[vertices[k]] = slot;
    across_[slot] = beyond[k].slot;
    mark_[slot] = beyond[k].mark;
    if (beyond[k].slot != kNone) across_[beyond[k].slot] = slot;
  }
  return t;
}

int PlanarMesh::turn_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return orientation_ * turn(*points_[a], *points_[b], *points_[c], plane_, planes_);
}

void PlanarMesh::improve() {
  queue_.clear();
  for (std::uint32_t slot = 0; slot < corners_.size(); ++slot) {
    if (corners_[slot - slot % 3] != kNone && across_[slot] != kNone && slot < across_[slot]) {
      queue_.push_back(slot);
    }
  }
  flip_while_better();
}

void PlanarMesh::flip_while_better() {
  // Each flip gains; the bound only stops what rounding might keep going.
  std::size_t flips_left = 16 * queue_.size();
  while (!queue_.empty() && flips_left > 0) {
    const std::uint32_t slot = queue_.back();
    queue_.pop_back();
    if (across_[slot] == kNone || mark_[slot] != kNone || !wants_flip(slot) ||
        (loose_ && !can_flip(slot)))
      continue;
    flip(slot);
    --flips_left;
    const std::uint32_t other = across_[slot];
    for (const std::uint32_t s :
         {next_slot(slot), previous_slot(slot), next_slot(other), previous_slot(other)}) {
      queue_.push_back(s);
    }
  }
}

// The edge a b between the triangles a b c and b a d: do the angles at c and d add up to more than
// half a turn, and is a d b c convex?
bool PlanarMesh::wants_flip(std::uint32_t slot) const {
  constexpr double kGain = 1e-9;
  const std::uint32_t other = across_[slot];
  const std::uint32_t a = corners_[slot], b = corners_[other];
  const std::uint32_t c = corners_[previous_slot(slot)], d = corners_[previous_slot(other)];
  const Vector ca = minus(points_[a]->position, points_[c]->position);
  const Vector cb = minus(points_[b]->position, points_[c]->position);
  const Vector da = minus(points_[a]->position, points_[d]->position);
  const Vector db = minus(points_[b]->position, points_[d]->position);
  const double scale = std::sqrt(dot(ca, ca) * dot(cb, cb) * dot(da, da) * dot(db, db));
  const double sine_of_sum =
      length_of_cross(ca, cb) * dot(da, db) + dot(ca, cb) * length_of_cross(da, db);
  return sine_of_sum < -kGain * scale && turn_of(a, d, c) > 0 && turn_of(d, b, c) > 0;
}

// Whether the two triangles at an edge are different ones that have no other edge in common.
bool PlanarMesh::can_flip(std::uint32_t slot) const {
  const std::uint32_t other = across_[slot];
  const auto is_beside = [&](std::uint32_t side) {
    const std::uint32_t beyond = across_[side];
    return beyond != kNone && (beyond / 3 == slot / 3 || beyond / 3 == other / 3);
  };
  return slot / 3 != other / 3 && !is_beside(next_slot(slot)) && !is_beside(previous_slot(slot)) &&
         !is_beside(next_slot(other)) && !is_beside(previous_slot(other));
}

// From a b c and b a d to d c a and c d b: the slots of the edge stay the edge's.
void PlanarMesh::flip(std::uint32_t slot) {
  const std::uint32_t other = across_[slot];
  const std::uint32_t bc = next_slot(slot), ca = previous_slot(slot);
  const std::uint32_t ad = next_slot(other), db = previous_slot(other);
  const std::uint32_t a = corners_[slot], b = corners_[other];
  const std::uint32_t c = corners_[ca], d = corners_[db];
  const Beyond of_bc = beyond(bc), of_ca = beyond(ca), of_ad = beyond(ad), of_db = beyond(db);
  const auto put = [&](std::uint32_t at, std::uint32_t vertex, const Beyond& side) {
    corners_[at] = vertex;
    slot_at_[vertex] = at;
    across_[at] = side.slot;
    mark_[at] = side.mark;
    if (side.slot != kNone) across_[side.slot] = at;
  };
  put(slot, d, {other, kNone});
  put(bc, c, of_ca);
  put(ca, a, of_ad);
  put(other, c, {slot, kNone});
  put(ad, d, of_db);
  put(db, b, of_bc);
}

}  // namespace meshrepair::internal
