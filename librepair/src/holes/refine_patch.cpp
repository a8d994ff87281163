// SPDX-License-Identifier: MIT
#include "refine_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>
#include <utility>

#include <base/angles.h>
#include <base/ids.h>

#include "rim.h"

namespace meshrepair::internal {
namespace {

constexpr int kMostTurnings = 20;  // of turning edges, after each pass of splitting

// Points are this much denser than where a triangle's middle is as far from its corners as the
// rim's points are apart (Liepa's alpha).
constexpr double kDensity = std::numbers::sqrt2;

// Points grow less dense from hop to hop inwards: far from the rim there is nothing to be shown in
// detail.
constexpr double kGrowth = 1.1;

class Refiner {
 public:
  Refiner(PatchMesh& patch, std::size_t most_points, const std::function<void()>& poll)
      : points_(patch.points),
        triangles_(patch.triangles),
        rim_(patch.points.size()),
        most_points_(most_points),
        poll_(poll) {
    find_neighbours();
    find_scales();
  }

  void run() {
    turn_edges();
    for (bool changed = true; changed && points_.size() < most_points_;) {
      if (poll_) poll_();
      changed = split_large();
      turn_edges();
    }
  }

 private:
  using Corners = std::array<std::uint32_t, 3>;

  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
  }

  void find_neighbours() {
    struct Side {
      std::uint64_t edge;
      std::uint32_t triangle;
      std::size_t side;
    };
    std::vector<Side> sides;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        sides.push_back({key(triangles_[t][k], triangles_[t][(k + 1) % 3]), t, k});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::pair(a.edge, a.triangle) < std::pair(b.edge, b.triangle);
    });
    neighbours_.assign(triangles_.size(), {kNone, kNone, kNone});
    for (std::size_t i = 0; i < sides.size(); ++i) {
      edges_.insert(sides[i].edge);
      if (i == 0 || sides[i].edge != sides[i - 1].edge) continue;
      neighbours_[sides[i].triangle][sides[i].side] = sides[i - 1].triangle;
      neighbours_[sides[i - 1].triangle][sides[i - 1].side] = sides[i].triangle;
    }
  }

  // Of a rim's point: the mean length of its two edges; of all at least what keeps the number of
  // points below the limit.
  void find_scales() {
    double area = 0;
    for (const Corners& t : triangles_) {
      area += triangle_area(points_[t[0]], points_[t[1]], points_[t[2]]);
    }
    // Two equilateral triangles for each point.
    const double least = std::sqrt(area / (0.87 * static_cast<double>(most_points_)));
    scales_.resize(rim_);
    for (std::size_t i = 0; i < rim_; ++i) {
      const Vec3d& before = points_[(i + rim_ - 1) % rim_];
      const Vec3d& behind = points_[(i + 1) % rim_];
      scales_[i] =
          std::max(least, 0.5 * ((points_[i] - before).norm() + (behind - points_[i]).norm()));
    }
  }

  bool split_large() {
    const std::size_t count = triangles_.size();
    bool changed = false;
    for (std::uint32_t t = 0; t < count; ++t) {
      const Corners c = triangles_[t];
      const Vec3d middle = (points_[c[0]] + points_[c[1]] + points_[c[2]]) / 3;
      const double scale = kGrowth * (scales_[c[0]] + scales_[c[1]] + scales_[c[2]]) / 3;
      const bool large = std::all_of(c.begin(), c.end(), [&](std::uint32_t p) {
        const double reach = kDensity * (points_[p] - middle).norm();
        return reach > scale && reach > scales_[p];
      });
      if (!large) continue;
      split(t, middle, scale);
      changed = true;
    }
    return changed;
  }

  void split(std::uint32_t t, const Vec3d& middle, double scale) {
    const auto added = static_cast<std::uint32_t>(points_.size());
    points_.push_back(middle);
    scales_.push_back(scale);
    const Corners c = triangles_[t];
    const Corners beyond = neighbours_[t];
    const auto second = static_cast<std::uint32_t>(triangles_.size());
    const std::uint32_t third = second + 1;
    triangles_[t] = {c[0], c[1], added};
    neighbours_[t] = {beyond[0], second, third};
    triangles_.push_back({c[1], c[2], added});
    neighbours_.push_back({beyond[1], third, t});
    triangles_.push_back({c[2], c[0], added});
    neighbours_.push_back({beyond[2], t, second});
    replace_neighbour(beyond[1], t, second);
    replace_neighbour(beyond[2], t, third);
    for (const std::uint32_t p : c) edges_.insert(key(p, added));
  }

  void replace_neighbour(std::uint32_t of, std::uint32_t from, std::uint32_t to) {
    if (of == kNone) return;
    *std::find(neighbours_[of].begin(), neighbours_[of].end(), from) = to;
  }

  void turn_edges() {
    for (int pass = 0; pass < kMostTurnings; ++pass) {
      bool changed = false;
      for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) changed |= turn_edge(t, k);
      }
      if (!changed) return;
    }
  }

  // The angle at the corner across side k.
  [[nodiscard]] double angle_across(std::uint32_t t, std::size_t k) const {
    const Corners& c = triangles_[t];
    const Vec3d& at = points_[c[(k + 2) % 3]];
    const Vec3d u = points_[c[k]] - at, v = points_[c[(k + 1) % 3]] - at;
    return arc_tangent(u.cross(v).norm(), u.dot(v));
  }

  // Turns side k of t into the other diagonal where the angles across it are more than half a turn.
  bool turn_edge(std::uint32_t t, std::size_t k) {
    constexpr double kClearly = 1e-6;  // or two edges might turn for ever
    const std::uint32_t s = neighbours_[t][k];
    if (s == kNone || s < t) return false;
    const Corners c = triangles_[t];
    const std::uint32_t a = c[k], b = c[(k + 1) % 3], top = c[(k + 2) % 3];
    // The neighbour passes the edge from b to a.
    std::size_t j = 0;
    while (triangles_[s][j] != b) ++j;
    if (triangles_[s][(j + 1) % 3] != a) return false;
    const std::uint32_t low = triangles_[s][(j + 2) % 3];
    if (top == low || edges_.contains(key(top, low))) return false;
    if (angle_across(t, k) + angle_across(s, j) <= std::numbers::pi + kClearly) return false;
    const std::uint32_t beyond_b = neighbours_[t][(k + 1) % 3];  // b, top
    const std::uint32_t beyond_a = neighbours_[s][(j + 1) % 3];  // a, low
    const std::uint32_t t_rest = neighbours_[t][(k + 2) % 3];    // top, a
    const std::uint32_t s_rest = neighbours_[s][(j + 2) % 3];    // low, b
    triangles_[t] = {a, low, top};
    neighbours_[t] = {beyond_a, s, t_rest};
    triangles_[s] = {low, b, top};
    neighbours_[s] = {s_rest, beyond_b, t};
    replace_neighbour(beyond_a, s, t);
    replace_neighbour(beyond_b, t, s);
    edges_.erase(key(a, b));
    edges_.insert(key(top, low));
    return true;
  }

  std::vector<Vec3d>& points_;
  std::vector<Corners>& triangles_;
  std::size_t rim_;
  std::size_t most_points_;
  const std::function<void()>& poll_;
  std::vector<Corners> neighbours_;  // of side k, from corner k to the next
  std::vector<double> scales_;       // of each point
  std::unordered_set<std::uint64_t> edges_;
};

}  // namespace

void refine_patch(PatchMesh& patch, std::size_t most_points, const std::function<void()>& poll) {
  Refiner(patch, most_points, poll).run();
}

}  // namespace meshrepair::internal
