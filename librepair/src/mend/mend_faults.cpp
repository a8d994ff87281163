// SPDX-License-Identifier: MIT
// A local search. For each pair of triangles at fault all small edits around it are tried: a
// corner, an edge or a triangle moved along the normal of one of the two by 1 to 128 steps of the
// numbers, a corner collapsed onto a neighbour, an edge flipped. The one that leaves the fewest
// faults among the triangles around it is made, with fewer points of the input moved and a shorter
// way as tie-breaks, and only if it leaves fewer than before. So the number of faults falls with
// each edit, and the search ends.
//
// Faults are counted exactly, among the triangles near the place alone
// (check/internal/fault_counter.h). All edits keep the surface a closed manifold of the same genus:
// a collapse has to satisfy the link condition (T. Dey, H. Edelsbrunner, S. Guha and D. Nekhayev,
// Topology preserving edge contraction, 1999).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <base/roots.h>
#include <check/box_tree.h>
#include <check/internal/fault_counter.h>
#include <check/internal/segments.h>
#include <check/internal/star_distance.h>
#include <exact/double_predicates.h>
#include <mesh/internal/collapsible_mesh.h>
#include <mesh/internal/editable_mesh.h>
#include <repair/internal/mend_faults.h>

namespace meshrepair::internal {
namespace {

// More faults than these are not of single places.
constexpr std::size_t kMostFaultyPairs = 1'000;

// Points with more triangles stay: to look at all of them so often takes too long.
constexpr std::size_t kMostAround = 48;

// How far points are moved along a normal, in steps of the numbers.
constexpr std::array<double, 8> kShifts{1, 2, 4, 8, 16, 32, 64, kMostMendShift};

// Around what edits of these pairs may change, and as far beyond it as it is large.
std::vector<Box> places_of(const EditableMesh& mesh, const std::vector<Vec3d>& points,
                           const std::vector<std::array<std::uint32_t, 2>>& pairs) {
  std::vector<Box> places;
  for (const auto& pair : pairs) {
    Box& place = places.emplace_back();
    for (const std::uint32_t t : pair) {
      for (const std::uint32_t corner : mesh.triangles()[t]) {
        for (const std::uint32_t around : mesh.triangles_of(corner)) {
          for (const std::uint32_t p : mesh.triangles()[around]) place.add(points[p]);
        }
      }
    }
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) size = std::max(size, place.high[k] - place.low[k]);
    place.widen(size);
  }
  return places;
}

class FaultMender {
 public:
  FaultMender(Surface& surface, const MendOptions& options,
              const std::vector<std::array<std::uint32_t, 2>>& pairs)
      : surface_(surface),
        points_(surface.mesh.points),
        options_(options),
        cancel_(options.progress),
        mesh_(surface.mesh.triangles, points_.size()),
        faults_(surface.mesh, 2 * kMostMendShift * options.step, places_of(mesh_, points_, pairs)) {
  }

  // Makes the edit around the two triangles that leaves the fewest faults, if it leaves fewer.
  bool improve(std::uint32_t t, std::uint32_t u) {
    if (!mesh_.is_left(t) || !mesh_.is_left(u)) return false;
    cancel_.tick();
    if (!find_best(t, u)) return false;
    make_best();
    return true;
  }

  [[nodiscard]] const EditableMesh& mesh() const { return mesh_; }

 private:
  struct Place {
    std::uint32_t point;
    Vec3d to;
  };

  struct Edit {
    MeshEdit mesh;
    std::vector<Place> places;
    std::ptrdiff_t gain = 0;
    std::size_t input_points = 0;  // that go or move
    double distance = 0;
  };

  // One point first; an edge or a triangle where that is of no use.
  bool find_best(std::uint32_t t, std::uint32_t u) {
    best_ = {};
    const std::array<std::uint32_t, 2> pair{t, u};
    const std::size_t size = t == u ? 1 : 2;
    const std::array<std::optional<Vec3d>, 2> normals{normal_of(mesh_.triangles()[t]),
                                                      normal_of(mesh_.triangles()[u])};
    for (std::size_t i = 0; i < size; ++i) {
      const TriangleCorners corners = mesh_.triangles()[pair[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        try_to_shift({corners[k]}, normals);
        try_to_collapse(corners[k]);
        try_to_flip(pair[i], k);
      }
    }
    if (best_.gain > 0) return true;
    for (std::size_t i = 0; i < size; ++i) {
      const TriangleCorners corners = mesh_.triangles()[pair[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        try_to_shift({corners[k], corners[(k + 1) % 3]}, normals);
      }
      try_to_shift({corners.begin(), corners.end()}, normals);
    }
    return best_.gain > 0;
  }

  [[nodiscard]] std::optional<Vec3d> normal_of(const TriangleCorners& c) const {
    const Vec3d normal = (points_[c[1]] - points_[c[0]]).cross(points_[c[2]] - points_[c[0]]);
    const double length = stable_length(normal);
    if (!(length > 0)) return std::nullopt;
    return Vec3d(normal / length);
  }

  void make_best() {
    for (const Place& place : best_.places) {
      points_[place.point] = place.to;
      surface_.input_point[place.point] = 0;
    }
    faults_.add_changed(best_.mesh.triangles);
    mesh_.apply(best_.mesh);
  }

  void take_if_better(const Edit& edit) {
    if (edit.gain > 0 && std::tuple(-edit.gain, edit.input_points, edit.distance) <
                             std::tuple(-best_.gain, best_.input_points, best_.distance)) {
      best_ = edit;
    }
  }

  void try_to_shift(const std::vector<std::uint32_t>& points,
                    const std::array<std::optional<Vec3d>, 2>& normals) {
    Edit edit;
    if (!take_stars(points, edit)) return;
    const double farthest = 2 * kMostMendShift * options_.step;
    const std::ptrdiff_t before = faults_.start(mesh_, edit.mesh.triangles, farthest);
    if (before == 0) return;
    std::vector<Vec3d> from(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) from[i] = points_[points[i]];
    for (const auto& normal : normals) {
      if (!normal) continue;
      for (const double steps : kShifts) {
        for (const double sign : {1.0, -1.0}) {
          shift(from, points, sign * steps * options_.step * *normal, edit);
          if (edit.distance == 0) continue;
          const std::ptrdiff_t least = std::max<std::ptrdiff_t>(best_.gain, 1);
          edit.gain = before - faults_.count(edit.mesh.now, before - least);
          take_if_better(edit);
        }
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i) points_[points[i]] = from[i];
  }

  // All triangles of the points, which stay what they are. False for too many.
  bool take_stars(const std::vector<std::uint32_t>& points, Edit& edit) const {
    std::vector<std::uint32_t>& triangles = edit.mesh.triangles;
    for (const std::uint32_t p : points) {
      const auto around = mesh_.triangles_of(p);
      triangles.insert(triangles.end(), around.begin(), around.end());
      edit.input_points += surface_.input_point[p] != 0 ? 1 : 0;
    }
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    if (triangles.size() > kMostAround) return false;
    for (const std::uint32_t t : triangles) edit.mesh.now.push_back(mesh_.triangles()[t]);
    return true;
  }

  // Puts the points there, as an edit that can be made.
  void shift(const std::vector<Vec3d>& from, const std::vector<std::uint32_t>& points,
             const Vec3d& by, Edit& edit) {
    edit.places.clear();
    edit.distance = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3d to = options_.rounded(from[i] + by);
      edit.places.push_back({points[i], to});
      edit.distance = std::max(edit.distance, (to - from[i]).norm());
      points_[points[i]] = to;
    }
  }

  void try_to_collapse(std::uint32_t point) {
    std::vector<std::uint32_t> link;
    if (!mesh_.find_link(point, link) || link.size() > kMostAround) return;
    const std::ptrdiff_t before = faults_.start(mesh_, mesh_.triangles_of(point));
    if (before == 0) return;
    link_.clear();
    for (const std::uint32_t p : link) link_.push_back(points_[p]);
    star_distance_.set_star(points_[point], link_);
    Edit edit;
    edit.input_points = surface_.input_point[point] != 0 ? 1 : 0;
    for (std::size_t to = 0; to < link.size(); ++to) {
      const double length = stable_length(link_[to] - points_[point]);
      edit.distance = std::min(star_distance_.bound(to, options_.within), length);
      if (!(edit.distance <= options_.within)) continue;
      if (!mesh_.find_collapse(point, link[to], edit.mesh)) continue;
      edit.gain = before - faults_.count(edit.mesh.now);
      take_if_better(edit);
    }
  }

  // Of the edge from corner k.
  void try_to_flip(std::uint32_t triangle, std::size_t k) {
    Edit edit;
    if (!mesh_.find_flip(triangle, k, edit.mesh)) return;
    if (!lie_beside_each_other(edit.mesh)) return;
    const TriangleCorners& one = edit.mesh.now[0];
    const TriangleCorners& old = mesh_.triangles()[triangle];
    edit.distance = distance_of_lines({points_[one[0]], points_[one[1]]},
                                      {points_[old[k]], points_[old[(k + 1) % 3]]});
    if (!(edit.distance <= options_.within)) return;
    const std::ptrdiff_t before = faults_.start(mesh_, edit.mesh.triangles);
    if (before == 0) return;
    edit.gain = before - faults_.count(edit.mesh.now);
    take_if_better(edit);
  }

  // Before and after: no triangle is folded over the other. Without area it is no matter.
  [[nodiscard]] bool lie_beside_each_other(const MeshEdit& flip) const {
    const auto one = normal_of(flip.now[0]), two = normal_of(flip.now[1]);
    if (!one || !two || !(one->dot(*two) > 0)) return false;
    return std::all_of(flip.triangles.begin(), flip.triangles.end(), [&](std::uint32_t t) {
      const auto before = normal_of(mesh_.triangles()[t]);
      return !before || (before->dot(*one) > 0 && before->dot(*two) > 0);
    });
  }

  Surface& surface_;
  std::vector<Vec3d>& points_;
  const MendOptions& options_;
  CancelCheck cancel_;
  EditableMesh mesh_;
  FaultCounter faults_;
  Edit best_;
  StarDistance star_distance_;
  std::vector<Vec3d> link_;
};

// A degenerate triangle is a pair with itself.
std::vector<std::array<std::uint32_t, 2>> pairs_at_fault(const TriangleSoup& mesh,
                                                         const SelfIntersections& found) {
  auto pairs = found.pairs;
  for (std::uint32_t t = 0; found.degenerate > 0 && t < mesh.triangles.size(); ++t) {
    const TriangleCorners& c = mesh.triangles[t];
    if (projection_axis(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]) < 0) {
      pairs.push_back({t, t});
    }
  }
  return pairs;
}

}  // namespace

std::size_t mend_faults(Surface& surface, const SelfIntersections& found,
                        const MendOptions& options) {
  const auto pairs = pairs_at_fault(surface.mesh, found);
  if (pairs.empty() || pairs.size() > kMostFaultyPairs) return 0;
  FaultMender mender(surface, options, pairs);
  std::size_t edits = 0;
  for (const auto& [t, u] : pairs) {
    while (mender.improve(t, u)) ++edits;
  }
  if (edits == 0) return 0;
  std::vector<char> keep;
  keep.reserve(surface.mesh.triangles.size());
  for (std::uint32_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    keep.push_back(mender.mesh().is_left(t) ? 1 : 0);
  }
  surface.mesh.triangles = mender.mesh().triangles();
  keep_triangles(surface, keep);
  return edits;
}

namespace {

// The ends of the edges without length, those that are no points of the input first: they are the
// ones to be moved.
std::vector<std::uint32_t> find_ends(const Surface& surface) {
  const TriangleSoup& mesh = surface.mesh;
  std::vector<std::uint32_t> ends;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (mesh.points[a] == mesh.points[b]) ends.insert(ends.end(), {a, b});
    }
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::stable_partition(ends.begin(), ends.end(),
                        [&](std::uint32_t p) { return surface.input_point[p] == 0; });
  return ends;
}

}  // namespace

std::size_t join_ends(Surface& surface) {
  const std::vector<std::uint32_t> ends = find_ends(surface);
  if (ends.empty()) return 0;
  const std::vector<Vec3d>& points = surface.mesh.points;
  CollapsibleMesh mesh(surface.mesh.triangles, points.size());
  PointStar star;
  std::size_t joined = 0;
  for (const std::uint32_t p : ends) {
    if (!mesh.find_star(p, star)) continue;
    for (std::size_t i = 0; i < star.link.size(); ++i) {
      if (points[star.link[i]] != points[p] || !mesh.may_collapse(star, i)) continue;
      mesh.collapse(star, i);
      ++joined;
      break;
    }
  }
  if (joined == 0) return 0;
  std::vector<char> is_left;
  is_left.reserve(surface.mesh.triangles.size());
  for (std::uint32_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    is_left.push_back(mesh.is_left(t) ? 1 : 0);
  }
  surface.mesh.triangles = mesh.triangles();
  keep_triangles(surface, is_left);
  return joined;
}

}  // namespace meshrepair::internal
