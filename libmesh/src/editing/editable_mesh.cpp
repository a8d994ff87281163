// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include <mesh/internal/editable_mesh.h>

namespace meshrepair::internal {
namespace {

// Larger stars are left alone.
constexpr std::size_t kMostOfStar = 256;

std::size_t place_of(const TriangleCorners& corners, std::uint32_t point) {
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), point) -
                                  corners.begin());
}

bool has(const std::vector<std::uint32_t>& points, std::uint32_t point) {
  return std::find(points.begin(), points.end(), point) != points.end();
}

}  // namespace

EditableMesh::EditableMesh(std::vector<TriangleCorners> triangles, std::size_t points)
    : triangles_(std::move(triangles)),
      first_(points + 2),
      around_(3 * triangles_.size()),
      list_of_(points, kNone) {
  // Shifted by one, so that entries are where the next triangle goes, and then where lists begin.
  for (const TriangleCorners& corners : triangles_) {
    for (const std::uint32_t p : corners) ++first_[p + 2];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (const std::uint32_t p : triangles_[t]) around_[first_[p + 1]++] = t;
  }
}

std::vector<std::uint32_t>& EditableMesh::changed_list(std::uint32_t point) {
  std::uint32_t& list = list_of_[point];
  if (list == kNone) {
    const std::span<const std::uint32_t> before = triangles_of(point);
    list = static_cast<std::uint32_t>(lists_.size());
    lists_.emplace_back(before.begin(), before.end());
  }
  return lists_[list];
}

bool EditableMesh::find_link(std::uint32_t point, std::vector<std::uint32_t>& link) const {
  const auto around = triangles_of(point);
  link.clear();
  if (around.size() < 3 || around.size() > kMostOfStar) return false;
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (const std::uint32_t t : around) {
    const std::size_t k = place_of(triangles_[t], point);
    sides.push_back({triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3]});
  }
  std::uint32_t next = sides[0][0];
  // Each side once: where several fans meet, none of them is the link.
  for (auto from = sides.begin(); from != sides.end(); ++from) {
    const auto side = std::find_if(from, sides.end(), [&](const auto& s) { return s[0] == next; });
    if (side == sides.end()) return false;
    link.push_back(next);
    next = (*side)[1];
    std::iter_swap(from, side);
  }
  return next == link[0];
}

bool EditableMesh::find_collapse(std::uint32_t point, std::uint32_t onto, MeshEdit& edit) const {
  std::vector<std::uint32_t> link, other;
  if (!find_link(point, link) || !find_link(onto, other)) return false;
  std::vector<std::uint32_t> common;
  std::copy_if(link.begin(), link.end(), std::back_inserter(common),
               [&](std::uint32_t p) { return has(other, p); });
  if (common.size() != 2 || link.size() + other.size() < 7) return false;
  if (std::any_of(common.begin(), common.end(),
                  [&](std::uint32_t p) { return triangles_of(p).size() < 4; })) {
    return false;
  }
  const auto around = triangles_of(point);
  edit.triangles.assign(around.begin(), around.end());
  edit.now.clear();
  for (const std::uint32_t t : edit.triangles) {
    TriangleCorners corners = triangles_[t];
    if (place_of(corners, onto) < 3) {
      corners = kGone;
    } else {
      corners[place_of(corners, point)] = onto;
    }
    edit.now.push_back(corners);
  }
  return true;
}

bool EditableMesh::find_flip(std::uint32_t triangle, std::size_t k, MeshEdit& edit) const {
  const TriangleCorners& corners = triangles_[triangle];
  const std::uint32_t from = corners[k], to = corners[(k + 1) % 3], left = corners[(k + 2) % 3];
  const auto around = triangles_of(from);
  const auto beside = std::find_if(around.begin(), around.end(), [&](std::uint32_t t) {
    const TriangleCorners& c = triangles_[t];
    return c[(place_of(c, to) + 1) % 3] == from && place_of(c, to) < 3;
  });
  if (beside == around.end()) return false;
  const TriangleCorners& other = triangles_[*beside];
  const std::uint32_t right = other[(place_of(other, from) + 1) % 3];
  std::vector<std::uint32_t> link;
  if (left == right || !find_link(left, link) || has(link, right)) return false;
  if (around.size() < 4 || triangles_of(to).size() < 4) return false;
  edit.triangles = {triangle, *beside};
  edit.now = {TriangleCorners{right, left, from}, TriangleCorners{left, right, to}};
  return true;
}

void EditableMesh::apply(const MeshEdit& edit) {
  for (const std::uint32_t t : edit.triangles) {
    if (t >= triangles_.size()) triangles_.resize(t + std::size_t{1}, kGone);
  }
  for (const std::uint32_t t : edit.triangles) {
    if (triangles_[t] == kGone) continue;
    for (const std::uint32_t p : triangles_[t]) std::erase(changed_list(p), t);
  }
  for (std::size_t i = 0; i < edit.triangles.size(); ++i) {
    triangles_[edit.triangles[i]] = edit.now[i];
    if (edit.now[i] == kGone) continue;
    for (const std::uint32_t p : edit.now[i]) changed_list(p).push_back(edit.triangles[i]);
  }
}

}  // namespace meshrepair::internal
