// SPDX-License-Identifier: MIT
// What is near becomes the same, in the order of its dimension: corners near corners become one,
// then corners near edges come to lie on them, corners near faces come to lie in them, and edges
// that pass near each other get a corner in common. What one step makes may bring more together, so
// they are repeated until nothing changes; each adds what edges and faces have in common, of which
// there is only so much.
//
// A point that came to lie on something stays there, as what it was near first counts. Nearest
// pairs go first, with numbers as tie-break, so the result does not depend on the order in which
// boxes are found. Positions are rounded. What is then cut along these corners (near_mesh.h) has
// the same triangles on both sides, exactly, whatever was rounded.
#include "near_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <check/box_tree.h>

#include "level_faces.h"

namespace meshrepair::internal {
namespace {

// A corner of a body that is as far as the distance from three faces at once is so far from theirs.
const double kCornerDistance = std::sqrt(3.0);

// Each round adds what edges and faces have in common, of which there is only so much; most need
// three.
constexpr int kMostJoinings = 16;

// Where the lines a b and c d are nearest to each other, as shares of the ways; not inside both
// where they are parallel.
std::array<double, 2> nearest_shares(const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                     const Vec3d& d) {
  const Vec3d u = b - a, v = d - c, w = c - a;
  const Vec3d across = u.cross(v);
  const double squared = across.squaredNorm();
  if (!(squared > 0)) return {-1, -1};
  return {w.cross(v).dot(across) / squared, w.cross(u).dot(across) / squared};
}

Box box_around(const Vec3d& p, double radius) {
  Box box;
  box.add(p);
  box.widen(radius);
  return box;
}

std::vector<Box> boxes_of_edges(const NearMesh& mesh) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.edges.size());
  for (const NearMesh::Edge& edge : mesh.edges) {
    Box& box = boxes.emplace_back();
    for (const std::uint32_t p : edge.ends) box.add(mesh.at[p]);
  }
  return boxes;
}

}  // namespace

NearParts::NearParts(const TriangleSoup& soup, std::span<const NearFaces> pairs, double gap,
                     double distance, CancelCheck& check)
    : pairs_(pairs),
      radius_(kCornerDistance * distance),
      check_(check),
      mesh_(soup),
      is_placed_(soup.points.size(), 0) {
  list_edges();
  const Levels levels(soup, mesh_.corners, pairs, gap);
  (void)merge_points();
  levels.move_points(mesh_.corners, radius_, mesh_.at);
}

void NearParts::list_edges() {
  std::vector<EdgeEnds> ends;
  for (const NearFaces& pair : pairs_) {
    for (const std::uint32_t t : {pair.a, pair.b}) {
      for (std::size_t k = 0; k < 3; ++k) {
        ends.push_back(ascending(mesh_.corners[t][k], mesh_.corners[t][(k + 1) % 3]));
      }
    }
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (const EdgeEnds& edge : ends) mesh_.edges.push_back({edge, {}});
}

const NearMesh& NearParts::bring_together() {
  for (int round = 0; round < kMostJoinings; ++round) {
    check_.ask();
    bool is_changed = merge_points();
    is_changed |= put_on_edges();
    is_changed |= put_on_faces();
    is_changed |= cross_edges();
    if (!is_changed) break;
  }
  return mesh_;
}

std::vector<std::uint32_t> NearParts::near_points() const {
  std::vector<std::uint32_t> points;
  for (const NearMesh::Edge& edge : mesh_.edges) {
    points.insert(points.end(), edge.ends.begin(), edge.ends.end());
    points.insert(points.end(), edge.inner.begin(), edge.inner.end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

void NearParts::put(std::uint32_t point, const Vec3d& place) {
  if (std::exchange(is_placed_[point], 1) == 0) mesh_.at[point] = place;
}

struct NearParts::Merge {
  double apart;
  std::uint32_t a, b;
};

// The nearest first. None becomes wider than twice the radius.
bool NearParts::merge_points() {
  const std::vector<std::uint32_t> points = near_points();
  std::vector<Box> boxes;
  boxes.reserve(points.size());
  for (const std::uint32_t p : points) boxes.push_back(box_around(mesh_.at[p], 0));
  const BoxTree tree(boxes);
  std::vector<Merge> merges;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    check_.tick();
    const Box around = box_around(mesh_.at[points[i]], radius_);
    tree.visit([&](const Box& box) { return box.meets(around); },
               [&](std::uint32_t k) {
                 const double apart = (mesh_.at[points[k]] - mesh_.at[points[i]]).norm();
                 if (k > i && apart <= radius_) merges.push_back({apart, points[i], points[k]});
               });
  }
  if (merges.empty()) return false;
  std::sort(merges.begin(), merges.end(), [](const Merge& x, const Merge& y) {
    return std::tie(x.apart, x.a, x.b) < std::tie(y.apart, y.a, y.b);
  });
  std::vector<std::uint32_t> name(mesh_.at.size());
  std::iota(name.begin(), name.end(), 0);
  std::vector<std::vector<std::uint32_t>> members(mesh_.at.size());
  for (const std::uint32_t p : points) members[p] = {p};
  bool is_changed = false;
  for (const Merge& merge : merges) {
    const std::uint32_t a = std::min(name[merge.a], name[merge.b]);
    const std::uint32_t b = std::max(name[merge.a], name[merge.b]);
    if (a == b) continue;
    const bool is_wide = std::any_of(members[a].begin(), members[a].end(), [&](std::uint32_t p) {
      return std::any_of(members[b].begin(), members[b].end(), [&](std::uint32_t q) {
        return (mesh_.at[p] - mesh_.at[q]).norm() > 2 * radius_;
      });
    });
    if (is_wide) continue;
    is_changed = true;
    for (const std::uint32_t p : members[b]) name[p] = a;
    members[a].insert(members[a].end(), members[b].begin(), members[b].end());
    members[b].clear();
  }
  for (const std::uint32_t p : points) {
    if (members[p].size() < 2) continue;
    // What lies on something already stays there.
    const bool any_placed = std::any_of(members[p].begin(), members[p].end(),
                                        [&](std::uint32_t q) { return is_placed_[q] != 0; });
    Vec3d sum = Vec3d::Zero();
    double count = 0;
    for (const std::uint32_t q : members[p]) {
      if (any_placed && is_placed_[q] == 0) continue;
      sum += mesh_.at[q] - mesh_.at[p];
      ++count;
    }
    mesh_.at[p] += sum / count;
    is_placed_[p] = any_placed ? 1 : 0;
  }
  if (is_changed) rename(name);
  return is_changed;
}

void NearParts::rename(const std::vector<std::uint32_t>& name) {
  for (std::uint32_t& p : mesh_.name) p = name[p];
  for (IndexTriangle& t : mesh_.corners) t = {name[t[0]], name[t[1]], name[t[2]]};
  for (NearMesh::Edge& edge : mesh_.edges) {
    edge.ends = ascending(name[edge.ends[0]], name[edge.ends[1]]);
    for (std::uint32_t& p : edge.inner) p = name[p];
  }
  std::stable_sort(
      mesh_.edges.begin(), mesh_.edges.end(),
      [](const NearMesh::Edge& a, const NearMesh::Edge& b) { return a.ends < b.ends; });
  std::vector<NearMesh::Edge> kept;
  for (NearMesh::Edge& edge : mesh_.edges) {
    if (edge.ends[0] == edge.ends[1]) continue;
    if (kept.empty() || kept.back().ends != edge.ends) {
      kept.push_back({edge.ends, {}});
    }
    std::vector<std::uint32_t>& inner = kept.back().inner;
    for (const std::uint32_t p : edge.inner) {
      if (p != edge.ends[0] && p != edge.ends[1] && !has(inner, p)) inner.push_back(p);
    }
  }
  mesh_.edges = std::move(kept);
  for (std::vector<std::uint32_t>& inner : mesh_.inner) {
    for (std::uint32_t& p : inner) p = name[p];
    std::sort(inner.begin(), inner.end());
    inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  }
}

bool NearParts::put_on_edges() {
  const std::vector<Box> boxes = boxes_of_edges(mesh_);
  const BoxTree tree(boxes);
  bool is_changed = false;
  for (const std::uint32_t p : near_points()) {
    check_.tick();
    const Box around = box_around(mesh_.at[p], radius_);
    std::vector<std::uint32_t> near;
    tree.visit([&](const Box& box) { return box.meets(around); },
               [&](std::uint32_t e) {
                 if (boxes[e].meets(around)) near.push_back(e);
               });
    std::sort(near.begin(), near.end());
    for (const std::uint32_t e : near) {
      NearMesh::Edge& edge = mesh_.edges[e];
      if (p == edge.ends[0] || p == edge.ends[1] || has(edge.inner, p)) continue;
      const Vec3d &a = mesh_.at[edge.ends[0]], &b = mesh_.at[edge.ends[1]];
      const double share = share_along(mesh_.at[p], a, b);
      const Vec3d place = a + share * (b - a);
      if (!(share > 0 && share < 1) || (place - mesh_.at[p]).norm() > radius_) continue;
      edge.inner.push_back(p);
      put(p, place);
      is_changed = true;
    }
  }
  return is_changed;
}

// Those on its outline, ascending.
std::vector<std::uint32_t> NearParts::points_of(std::uint32_t triangle) const {
  std::vector<std::uint32_t> points;
  const IndexTriangle& t = mesh_.corners[triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    points.push_back(t[k]);
    const std::uint32_t e = mesh_.edge_between(t[k], t[(k + 1) % 3]);
    if (e == kNone) continue;
    points.insert(points.end(), mesh_.edges[e].inner.begin(), mesh_.edges[e].inner.end());
  }
  std::sort(points.begin(), points.end());
  return points;
}

bool NearParts::put_on_faces() {
  bool is_changed = false;
  for (const NearFaces& pair : pairs_) {
    check_.tick();
    const std::vector<std::uint32_t> of_a = points_of(pair.a), of_b = points_of(pair.b);
    for (const std::uint32_t p : of_b) {
      if (!std::binary_search(of_a.begin(), of_a.end(), p)) is_changed |= put_on_face(p, pair.a);
    }
    for (const std::uint32_t p : of_a) {
      if (!std::binary_search(of_b.begin(), of_b.end(), p)) is_changed |= put_on_face(p, pair.b);
    }
  }
  return is_changed;
}

bool NearParts::put_on_face(std::uint32_t point, std::uint32_t triangle) {
  std::vector<std::uint32_t>& inner = mesh_.inner[triangle];
  const auto before = std::lower_bound(inner.begin(), inner.end(), point);
  if (before != inner.end() && *before == point) return false;
  const IndexTriangle& t = mesh_.corners[triangle];
  const Vec3d &a = mesh_.at[t[0]], &b = mesh_.at[t[1]], &c = mesh_.at[t[2]], &p = mesh_.at[point];
  const Vec3d area = (b - a).cross(c - a);
  const double squared = area.squaredNorm();
  if (!(squared > 0)) return false;
  const double height = area.dot(p - a) / std::sqrt(squared);
  const auto is_left = [&](const Vec3d& q, const Vec3d& r) {
    return (r - q).cross(p - q).dot(area) > 0;
  };
  if (std::abs(height) > radius_ || !is_left(a, b) || !is_left(b, c) || !is_left(c, a)) {
    return false;
  }
  inner.insert(before, point);
  put(point, p - area * (area.dot(p - a) / squared));
  return true;
}

bool NearParts::cross_edges() {
  const std::vector<Box> boxes = boxes_of_edges(mesh_);
  const BoxTree tree(boxes);
  bool is_changed = false;
  for (std::uint32_t e = 0; e < mesh_.edges.size(); ++e) {
    check_.tick();
    Box around = boxes[e];
    around.widen(radius_);
    std::vector<std::uint32_t> near;
    tree.visit([&](const Box& box) { return box.meets(around); },
               [&](std::uint32_t f) {
                 if (f > e && boxes[f].meets(around)) near.push_back(f);
               });
    std::sort(near.begin(), near.end());
    for (const std::uint32_t f : near) {
      NearMesh::Edge &x = mesh_.edges[e], &y = mesh_.edges[f];
      const auto is_of = [](const NearMesh::Edge& edge, std::uint32_t p) {
        return p == edge.ends[0] || p == edge.ends[1] || has(edge.inner, p);
      };
      const auto meets_y = [&](std::uint32_t p) { return is_of(y, p); };
      if (std::any_of(x.ends.begin(), x.ends.end(), meets_y) ||
          std::any_of(x.inner.begin(), x.inner.end(), meets_y)) {
        continue;
      }
      const Vec3d &a = mesh_.at[x.ends[0]], &b = mesh_.at[x.ends[1]];
      const Vec3d &c = mesh_.at[y.ends[0]], &d = mesh_.at[y.ends[1]];
      const auto [s, t] = nearest_shares(a, b, c, d);
      if (!(s > 0 && s < 1 && t > 0 && t < 1)) continue;
      const Vec3d on_x = a + s * (b - a), on_y = c + t * (d - c);
      if ((on_x - on_y).norm() > radius_) continue;
      const auto fresh = static_cast<std::uint32_t>(mesh_.at.size());
      mesh_.at.push_back(on_x + 0.5 * (on_y - on_x));
      is_placed_.push_back(1);
      x.inner.push_back(fresh);
      y.inner.push_back(fresh);
      is_changed = true;
    }
  }
  return is_changed;
}

}  // namespace meshrepair::internal
