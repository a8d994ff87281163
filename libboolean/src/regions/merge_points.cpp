// SPDX-License-Identifier: MIT
#include "merge_points.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <base/roots.h>
#include <check/internal/fault_counter.h>
#include <check/internal/segments.h>
#include <mesh/internal/editable_mesh.h>

#include "region_edges.h"

namespace meshrepair::internal {
namespace {

// Points with more triangles stay: to look at all of them so often takes too long.
constexpr std::size_t kMostTrianglesOfPoint = 64;

constexpr std::size_t kNewPointsOfPair = 2;

// Whether the corners are passed the other way than if they were sorted.
bool is_odd(const TriangleCorners& c) { return (c[0] > c[1]) != ((c[1] > c[2]) != (c[0] > c[2])); }

bool has(const TriangleCorners& corners, std::uint32_t point) {
  return std::find(corners.begin(), corners.end(), point) != corners.end();
}

TriangleCorners sorted(TriangleCorners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

// Boxes around the triangles of pairs, and as far beyond them as they are large.
std::vector<Box> places_of(const TriangleSoup& mesh, const FaultyPairs& pairs) {
  std::vector<Box> places;
  for (const auto& pair : pairs) {
    Box& place = places.emplace_back();
    for (const std::uint32_t t : pair) {
      for (const std::uint32_t p : mesh.triangles[t]) place.add(mesh.points[p]);
    }
    place.widen(place.diagonal());
  }
  return places;
}

class PointMerger {
 public:
  PointMerger(RegionComplex& complex, const FaultyPairs& pairs, const MergeOptions& options)
      : complex_(complex),
        points_(complex.mesh.points),
        within_(options.within),
        precision_(options.precision),
        new_point_(static_cast<std::uint32_t>(points_.size())),
        cancel_(options.progress),
        mesh_(complex.mesh.triangles, points_.size() + kNewPointsOfPair * pairs.size()),
        faults_(complex.mesh, 0, places_of(complex.mesh, pairs)),
        joined_(complex.region_of_part.size()) {
    points_.resize(points_.size() + kNewPointsOfPair * pairs.size(), Vec3d::Zero());
  }

  // Makes the merger around the two triangles that leaves the fewest faults, if it leaves fewer.
  bool improve(std::uint32_t t, std::uint32_t u) {
    if (!mesh_.is_left(t) || !mesh_.is_left(u)) return false;
    cancel_.tick();
    best_ = {};
    const TriangleCorners &a = mesh_.triangles()[t], &b = mesh_.triangles()[u];
    if (t != u && sorted(a) == sorted(b)) try_to_merge(a[0], a[0]);
    for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
      for (std::size_t k = 0; k < 3; ++k) {
        try_mergers(one[k], other);
        try_to_split(one[(k + 1) % 3], one[(k + 2) % 3], one[k]);
        try_to_flip(one[(k + 1) % 3], one[(k + 2) % 3]);
        for (const std::uint32_t p : other) try_to_split(one[(k + 1) % 3], one[(k + 2) % 3], p);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = 0; l < 3; ++l) try_to_cross(a[k], a[(k + 1) % 3], b[l], b[(l + 1) % 3]);
    }
    if (best_.gain <= 0) return false;
    make_best();
    return true;
  }

  // The most that an edge or a point moved.
  [[nodiscard]] double distance() const { return distance_; }

  // Into the complex.
  void finish() {
    std::vector<std::uint32_t> becomes;
    for (std::uint32_t part = 0; part < complex_.region_of_part.size(); ++part) {
      becomes.push_back(joined_.root(part));
    }
    complex_.mesh.triangles = mesh_.triangles();
    complex_ = compacted(complex_, becomes);
  }

 private:
  struct Merger {
    MeshEdit mesh;
    TriangleSides sides;                                 // of each triangle, then
    std::vector<std::array<std::uint32_t, 2>> one_part;  // that are
    std::vector<std::uint32_t> from;                     // of each triangle, which it was a part of
    std::ptrdiff_t gain = 0;
    double distance = 0;
    std::optional<Vec3d> new_point;
  };

  // Of the point with its neighbours, and with the corners of another triangle.
  void try_mergers(std::uint32_t point, const TriangleCorners& other) {
    targets_.assign(other.begin(), other.end());
    for (const std::uint32_t t : mesh_.triangles_of(point)) {
      targets_.insert(targets_.end(), mesh_.triangles()[t].begin(), mesh_.triangles()[t].end());
    }
    std::sort(targets_.begin(), targets_.end());
    targets_.erase(std::unique(targets_.begin(), targets_.end()), targets_.end());
    for (const std::uint32_t to : targets_) {
      if (to == point || !(stable_length(points_[to] - points_[point]) <= within_)) continue;
      try_to_merge(point, to);
    }
  }

  // Moves the point there.
  void try_to_merge(std::uint32_t point, std::uint32_t to) {
    Merger merger;
    if (!begin(merger, {mesh_.triangles_of(point), mesh_.triangles_of(to)})) return;
    for (TriangleCorners& corners : merger.mesh.now) {
      const bool has_target = has(corners, to);
      if (point == to || !has(corners, point)) continue;
      std::replace(corners.begin(), corners.end(), point, to);
      if (has_target) corners = kGone;
    }
    merger.distance = stable_length(points_[to] - points_[point]);
    take_if_better(merger);
  }

  // Leads the edge from a to b over the point.
  void try_to_split(std::uint32_t a, std::uint32_t b, std::uint32_t point) {
    if (a == point || b == point) return;
    Merger merger;
    merger.distance = distance_from_edge(a, b, point);
    if (!(merger.distance <= within_)) return;
    if (!begin(merger, {mesh_.triangles_of(a), mesh_.triangles_of(point)})) return;
    lead_over(merger, a, b, point);
    take_if_better(merger);
  }

  // Leads two edges over a new point between them.
  void try_to_cross(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (a == c || a == d || b == c || b == d || new_point_ == points_.size()) return;
    const Segment one = {points_[a], points_[b]}, other = {points_[c], points_[d]};
    const auto [from, to] = shortest_between(one, other);
    if (from == one.from || from == one.to || to == other.from || to == other.to) return;
    Merger merger;
    merger.distance = stable_length(to - from);
    if (!(merger.distance <= within_)) return;
    if (!begin(merger, {mesh_.triangles_of(a), mesh_.triangles_of(c)})) return;
    points_[new_point_] = rounded_to(0.5 * (from + to), precision_);
    merger.new_point = points_[new_point_];
    lead_over(merger, a, b, new_point_);
    lead_over(merger, c, d, new_point_);
    take_if_better(merger);
  }

  // Divides the triangles at the edge from a to b there.
  void lead_over(Merger& merger, std::uint32_t a, std::uint32_t b, std::uint32_t point) const {
    auto& [triangles, now] = merger.mesh;
    const std::size_t count = now.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (!has(now[i], a) || !has(now[i], b)) continue;
      if (has(now[i], point)) {
        now[i] = kGone;
        continue;
      }
      TriangleCorners other = now[i];
      std::replace(now[i].begin(), now[i].end(), b, point);
      std::replace(other.begin(), other.end(), a, point);
      triangles.push_back(
          std::max(static_cast<std::uint32_t>(mesh_.triangles().size()), triangles.back() + 1));
      now.push_back(other);
      merger.sides.push_back(merger.sides[i]);
      merger.from.push_back(merger.from[i]);
    }
  }

  // Turns the edge from a to b, at which two triangles are.
  void try_to_flip(std::uint32_t a, std::uint32_t b) {
    Merger merger;
    if (!begin(merger, {mesh_.triangles_of(a), mesh_.triangles_of(b)})) return;
    auto& now = merger.mesh.now;
    std::vector<std::size_t> beside;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (has(now[i], a) && has(now[i], b)) beside.push_back(i);
    }
    if (beside.size() != 2) return;
    const auto apex = [&](const TriangleCorners& c) {
      return *std::find_if(c.begin(), c.end(), [&](std::uint32_t p) { return p != a && p != b; });
    };
    TriangleCorners &one = now[beside[0]], &other = now[beside[1]];
    const std::uint32_t c = apex(one), d = apex(other);
    if (c == d) return;
    merger.distance = distance_of_lines({points_[a], points_[b]}, {points_[c], points_[d]});
    if (!(merger.distance <= within_)) return;
    std::replace(one.begin(), one.end(), b, d);
    std::replace(other.begin(), other.end(), a, c);
    take_if_better(merger);
  }

  [[nodiscard]] double distance_from_edge(std::uint32_t a, std::uint32_t b, std::uint32_t p) const {
    const Vec3d along = points_[b] - points_[a], to = points_[p] - points_[a];
    const double share = along.dot(to) / along.squaredNorm();
    if (!(share > 0 && share < 1)) return std::numeric_limits<double>::infinity();
    return stable_length(to - share * along);
  }

  // Takes all triangles of some points, as they are now. False where they are too many.
  bool begin(Merger& merger, std::array<std::span<const std::uint32_t>, 2> around) {
    if (around[0].size() + around[1].size() > kMostTrianglesOfPoint) return false;
    auto& triangles = merger.mesh.triangles;
    for (const auto& some : around) triangles.insert(triangles.end(), some.begin(), some.end());
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    merger.gain = faults_.start(mesh_, triangles);
    for (const std::uint32_t t : triangles) {
      merger.mesh.now.push_back(mesh_.triangles()[t]);
      merger.sides.push_back(complex_.parts_of[t]);
      merger.from.push_back(t);
    }
    return true;
  }

  void take_if_better(Merger& merger) {
    if (!add_up(merger)) return;
    merger.gain -= faults_.count(merger.mesh.now);
    merger.gain += turned_edges_less(merger);
    if (merger.gain > 0 &&
        std::tuple(-merger.gain, merger.distance) < std::tuple(-best_.gain, best_.distance)) {
      best_ = std::move(merger);
    }
  }

  // How many edges of its triangles it turns back, at most those.
  std::ptrdiff_t turned_edges_less(const Merger& merger) {
    edges_.clear();
    const auto add_edges = [&](const TriangleCorners& c) {
      if (c == kGone) return;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(c[k], c[(k + 1) % 3]);
        edges_.push_back({a, b});
      }
    };
    for (const std::uint32_t t : merger.mesh.triangles) {
      if (t < mesh_.triangles().size()) add_edges(mesh_.triangles()[t]);
    }
    for (const TriangleCorners& corners : merger.mesh.now) add_edges(corners);
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    std::ptrdiff_t less = 0;
    for (const auto& [a, b] : edges_) {
      less += is_turned_edge(a, b, nullptr) ? 1 : 0;
      less -= is_turned_edge(a, b, &merger) ? 1 : 0;
    }
    return less;
  }

  // Now, or once the merger is made.
  bool is_turned_edge(std::uint32_t a, std::uint32_t b, const Merger* merger) {
    pages_.clear();
    const auto add = [&](const TriangleCorners& corners, std::array<std::uint32_t, 2> sides) {
      if (corners == kGone || !has(corners, a) || !has(corners, b)) return;
      for (std::uint32_t& part : sides) part = joined_.root(part);
      pages_.push_back(page_at(a, b, corners, sides));
    };
    for (const std::uint32_t t : mesh_.triangles_of(a)) {
      const bool is_touched =
          merger != nullptr &&
          std::binary_search(merger->mesh.triangles.begin(), merger->mesh.triangles.end(), t);
      if (!is_touched) add(mesh_.triangles()[t], complex_.parts_of[t]);
    }
    for (std::size_t i = 0; merger != nullptr && i < merger->mesh.now.size(); ++i) {
      add(merger->mesh.now[i], merger->sides[i]);
    }
    return is_turned(points_, a, b, pages_);
  }

  // Makes equal triangles one, or none. False where more than two parts would be at one.
  bool add_up(Merger& merger) {
    auto& now = merger.mesh.now;
    order_.clear();
    for (std::uint32_t i = 0; i < now.size(); ++i) {
      if (now[i] != kGone) order_.emplace_back(sorted(now[i]), i);
    }
    std::sort(order_.begin(), order_.end());
    for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
      while (end < order_.size() && order_[end].first == order_[begin].first) ++end;
      if (end - begin == 1) continue;
      const auto sides = sum_of(merger, begin, end);
      if (!sides) return false;
      for (std::size_t i = begin + 1; i < end; ++i) now[order_[i].second] = kGone;
      const std::uint32_t first = order_[begin].second;
      if (region((*sides)[0]) == region((*sides)[1])) {
        merger.one_part.push_back(*sides);
        now[first] = kGone;
      } else {
        now[first] = order_[begin].first;
        merger.sides[first] = *sides;
      }
    }
    return true;
  }

  // What is in front of the sorted triangle and behind it; twice the same where they cancel out.
  std::optional<std::array<std::uint32_t, 2>> sum_of(const Merger& merger, std::size_t begin,
                                                     std::size_t end) {
    front_.clear();
    behind_.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t at = order_[i].second;
      auto [front, behind] = merger.sides[at];
      if (is_odd(merger.mesh.now[at])) std::swap(front, behind);
      front_.push_back(joined_.root(front));
      behind_.push_back(joined_.root(behind));
    }
    const std::uint32_t any = front_[0];
    for (std::size_t i = 0; i < front_.size();) {
      const auto same = std::find(behind_.begin(), behind_.end(), front_[i]);
      if (same == behind_.end()) {
        ++i;
        continue;
      }
      behind_.erase(same);
      front_.erase(front_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (front_.size() > 1) return std::nullopt;
    if (front_.empty()) return std::array{any, any};
    return std::array{front_[0], behind_[0]};
  }

  [[nodiscard]] std::uint32_t region(std::uint32_t part) const {
    return complex_.region_of_part[part];
  }

  void make_best() {
    for (std::size_t i = 0; i < best_.mesh.triangles.size(); ++i) {
      const std::uint32_t t = best_.mesh.triangles[i];
      if (t >= complex_.parts_of.size()) {
        complex_.parts_of.resize(t + std::size_t{1});
        complex_.source.resize(t + std::size_t{1});
      }
      complex_.parts_of[t] = best_.sides[i];
      complex_.source[t] = complex_.source[best_.from[i]];
    }
    for (const auto& [a, b] : best_.one_part) joined_.join(a, b);
    if (best_.new_point) points_[new_point_++] = *best_.new_point;
    distance_ = std::max(distance_, best_.distance);
    faults_.add_changed(best_.mesh.triangles);
    mesh_.apply(best_.mesh);
  }

  RegionComplex& complex_;
  std::vector<Vec3d>& points_;
  double within_;
  Precision precision_;
  std::uint32_t new_point_;  // the next one, of those that are kept for that
  CancelCheck cancel_;
  EditableMesh mesh_;
  FaultCounter faults_;
  DisjointSets joined_;  // parts
  Merger best_;
  double distance_ = 0;
  std::vector<std::array<std::uint32_t, 2>> edges_;               // scratch
  std::vector<EdgePage> pages_;                                   // scratch
  std::vector<std::uint32_t> targets_, front_, behind_;           // scratch
  std::vector<std::pair<TriangleCorners, std::uint32_t>> order_;  // scratch
};

}  // namespace

std::size_t merge_points(RegionComplex& complex, const FaultyPairs& pairs,
                         const MergeOptions& options, double& distance) {
  PointMerger merger(complex, pairs, options);
  std::size_t edits = 0;
  for (const auto& [t, u] : pairs) {
    while (merger.improve(t, u)) ++edits;
  }
  distance = merger.distance();
  if (edits > 0) merger.finish();
  return edits;
}

}  // namespace meshrepair::internal
