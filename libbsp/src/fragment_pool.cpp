// SPDX-License-Identifier: MIT
#include "fragment_pool.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

// Edge k of the input triangle is written as kOriginalEdge + k until its plane is needed: most
// fragments are never cut.
constexpr std::uint32_t kOriginalEdge = 0xFFFFFFF0u;

bool is_original(PlaneId edge) { return edge.value >= kOriginalEdge; }

}  // namespace

FragmentPool::FragmentPool(const CleanSoup& soup) : soup_(soup), planes_(soup.planes) {
  planes_.release_index();
  fragments_.reserve(soup.triangles.size());
  corners_.reserve(3 * soup.triangles.size());
  for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
    const Triangle& triangle = soup.triangles[t];
    Fragment f;
    f.triangle = t;
    f.plane = triangle.plane;
    f.count = 3;
    f.first = begin_of_list(corners_.size(), f.count);
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners_.push_back(
          {lattice_point(soup.grid_points[triangle.corners[k]]), PlaneId(kOriginalEdge + k)});
    }
    set_bounds(f);
    fragments_.push_back(f);
  }
}

FragmentPool::FragmentPool(const FragmentPool& other, std::span<const FragmentId> fragments)
    : soup_(other.soup_) {
  std::size_t corners = 0;
  for (const FragmentId id : fragments) corners += other[id].count;
  fragments_.reserve(fragments.size());
  corners_.reserve(corners);
  for (const FragmentId id : fragments) {
    Fragment f = other[id];
    const Corner* corner = other.corners(f);
    f.first = begin_of_list(corners_.size(), f.count);
    for (std::uint32_t i = 0; i < f.count; ++i) corners_.push_back(corner[i]);
    fragments_.push_back(f);
  }
  rename_planes(other);
}

// Sorts all places where planes are named by these names, and so meets each plane once, in order.
void FragmentPool::rename_planes(const FragmentPool& other) {
  std::vector<std::pair<PlaneId, PlaneId*>> places;
  places.reserve(fragments_.size() + fragments_.size() / 4);
  for (Fragment& f : fragments_) places.emplace_back(f.plane, &f.plane);
  for (Corner& corner : corners_) {
    if (!is_original(corner.edge)) places.emplace_back(corner.edge, &corner.edge);
    for (PlaneId& plane : corner.point.planes) {
      if (plane.valid()) places.emplace_back(plane, &plane);
    }
  }
  std::sort(places.begin(), places.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  PlaneId last;
  for (const auto& [plane, place] : places) {
    if (plane != last) {
      planes_.append(other.planes_[plane]);
      const PlaneId known = other.soup_plane(plane);
      if (known.valid()) soup_plane_ids_.push_back(known);
      last = plane;
    }
    *place = PlaneId(planes_.size() - 1);
  }
}

PlaneId FragmentPool::soup_plane(PlaneId plane) const {
  if (soup_plane_ids_.empty()) return plane.index() < soup_.planes.size() ? plane : PlaneId();
  return plane.index() < soup_plane_ids_.size() ? soup_plane_ids_[plane.index()] : PlaneId();
}

PlaneId FragmentPool::find(PlaneId soup_plane) const {
  if (soup_plane_ids_.empty()) return soup_plane;
  const auto found = std::lower_bound(soup_plane_ids_.begin(), soup_plane_ids_.end(), soup_plane);
  if (found == soup_plane_ids_.end() || *found != soup_plane) return {};
  return PlaneId(static_cast<std::size_t>(found - soup_plane_ids_.begin()));
}

FragmentPool::Pieces FragmentPool::split(FragmentId id, PlaneId by) {
  const Fragment f = fragments_[id.index()];
  bool any_front = false;
  bool any_back = false;
  sides_.resize(f.count);
  for (std::uint32_t i = 0; i < f.count; ++i) {
    sides_[i] = side(corners_[f.first + i].point, by, planes_);
    any_front |= sides_[i] > 0;
    any_back |= sides_[i] < 0;
  }
  if (!any_back) return {any_front ? id : FragmentId(), {}};
  if (!any_front) return {{}, id};

  front_.clear();
  back_.clear();
  for (std::uint32_t i = 0; i < f.count; ++i) {
    const std::uint32_t j = i + 1 < f.count ? i + 1 : 0;
    Corner& here = corners_[f.first + i];
    const Corner& next = corners_[f.first + j];
    // A corner on the plane belongs to both; on the piece that the polygon leaves there, the edge
    // that starts at it is the cut.
    if (sides_[i] >= 0)
      front_.push_back({here.point, sides_[i] == 0 && sides_[j] < 0 ? by : here.edge});
    if (sides_[i] <= 0)
      back_.push_back({here.point, sides_[i] == 0 && sides_[j] > 0 ? by : here.edge});
    if (sides_[i] * sides_[j] < 0) {
      const Point cut = cut_edge(f, here, next, by);
      front_.push_back({cut, sides_[i] > 0 ? by : here.edge});
      back_.push_back({cut, sides_[i] < 0 ? by : here.edge});
      // The corner before the cut was copied when its edge may not have had its plane yet.
      (sides_[i] > 0 ? front_ : back_).rbegin()[1].edge = here.edge;
    }
  }
  release(id);
  const FragmentId front = new_fragment(f, front_);
  return {front, new_fragment(f, back_)};
}

Point FragmentPool::cut_edge(const Fragment& f, Corner& from, const Corner& to, PlaneId by) {
  if (is_original(from.edge)) from.edge = planes_.append(plane_of_edge(f.triangle, from.edge));
  const auto& a = from.point.position;
  const auto& b = to.point.position;
  return meet(planes_, f.plane, from.edge, by,
              {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])});
}

// An edge that was not cut yet is one of a single fragment, so its plane is made once.
Plane FragmentPool::plane_of_edge(TriangleId triangle, PlaneId edge) const {
  const std::uint32_t k = edge.value - kOriginalEdge;
  const Triangle& t = soup_.triangles[triangle];
  return plane_along_axis(soup_.grid_points[t.corners[k]],
                          soup_.grid_points[t.corners[(k + 1) % 3]],
                          dominant_axis(soup_.planes[t.plane]));
}

FragmentId FragmentPool::new_fragment(const Fragment& parent, const std::vector<Corner>& corners) {
  Fragment f;
  f.triangle = parent.triangle;
  f.plane = parent.plane;
  f.count = static_cast<std::uint32_t>(corners.size());
  f.first = take_block(f.count);
  std::copy(corners.begin(), corners.end(), corners_.begin() + f.first);
  set_bounds(f);
  if (free_fragments_.empty()) {
    fragments_.push_back(f);
    return FragmentId(fragments_.size() - 1);
  }
  const FragmentId id = free_fragments_.back();
  free_fragments_.pop_back();
  fragments_[id.index()] = f;
  return id;
}

void FragmentPool::release(FragmentId id) {
  const Fragment& f = fragments_[id.index()];
  if (free_blocks_.size() <= f.count) free_blocks_.resize(f.count + 1);
  free_blocks_[f.count].push_back(f.first);
  free_fragments_.push_back(id);
}

std::uint32_t FragmentPool::take_block(std::uint32_t count) {
  if (count < free_blocks_.size() && !free_blocks_[count].empty()) {
    const std::uint32_t block = free_blocks_[count].back();
    free_blocks_[count].pop_back();
    return block;
  }
  const std::uint32_t block = begin_of_list(corners_.size(), count);
  corners_.resize(corners_.size() + count);
  return block;
}

void FragmentPool::set_bounds(Fragment& f) const {
  f.low.fill(std::numeric_limits<float>::max());
  f.high.fill(std::numeric_limits<float>::lowest());
  for (std::uint32_t i = 0; i < f.count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<float>(corners_[f.first + i].point.position[axis]);
      f.low[axis] = std::min(f.low[axis], x);
      f.high[axis] = std::max(f.high[axis], x);
    }
  }
}

}  // namespace meshrepair::internal
