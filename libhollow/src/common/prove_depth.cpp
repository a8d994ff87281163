// SPDX-License-Identifier: MIT
// Let d be the distance to the surface, and x a point of the convex hull of the corners v.
//
// - From above: the distance to one triangle is a convex function, so it is largest at a corner,
//   and d is nowhere above that, whichever triangle it is.
// - From below, first: d(x) >= d(v) - |x - v| for each v.
// - From below, second: let x be the mean of the corners with weights w, q the point of the surface
//   nearest to x, and c any point. As the mean of |v - y|^2 is least at x, and larger by |x - y|^2
//   elsewhere,
//     d(x)^2 = |q - x|^2 = mean |q - v|^2 - mean |x - v|^2 >= mean (d(v)^2 - |c - v|^2),
//   which is not below the least of d(v)^2 - |c - v|^2. So the loss is of second order in the size
//   of the piece. The smallest ball around it has the best c, if all corners are equally deep.
// - From below, third: a triangle and the piece are at least as far apart as their shadows on any
//   line.
//
// What is not decided so is cut in the middle of its longest edge.
#include "common/prove_depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

namespace meshrepair::internal {
namespace {

// A computed distance is off by a few units in the last place of the coordinates. The proofs are
// asked with a margin of 1e-3 of the distance at least, which is far more for all that has a wall:
// the thickness is above a millionth of the size.
constexpr std::size_t kMostApart = 24;  // triangles that are looked at one by one
constexpr int kCentres = 8;             // that are tried
constexpr double kWorthShadows = 0.3;   // of the distance: smaller pieces do without
constexpr double kRoom = 1.0625;        // of the distance, around the piece

struct LongestEdge {
  std::size_t from = 0, to = 0;
  double squared = 0;
};

LongestEdge longest_edge(const Piece& piece) {
  LongestEdge longest;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double squared = (piece[i].at - piece[j].at).squaredNorm();
      if (squared > longest.squared) longest = {i, j, squared};
    }
  }
  return longest;
}

// The least of d(v)^2 - |c - v|^2 for a good c, which moves to the corner that has it in smaller
// and smaller steps (as in M. Badoiu and K. Clarkson, "Smaller core-sets for balls", 2003).
double power_bound(const Piece& piece) {
  Vec3d centre = 0.25 * (piece[0].at + piece[1].at + piece[2].at + piece[3].at);
  double best = -std::numeric_limits<double>::infinity();
  for (int step = 0; step < kCentres; ++step) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t worst = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double power =
          piece[i].distance * piece[i].distance - (piece[i].at - centre).squaredNorm();
      if (power >= least) continue;
      least = power;
      worst = i;
    }
    best = std::max(best, least);
    centre += (piece[worst].at - centre) / (step + 2);
  }
  return best;
}

Box box_of(const Piece& piece) {
  Box box;
  for (const Place& corner : piece) box.add(corner.at);
  return box;
}

// Between their shadows on a line.
double gap_along(const Vec3d& line, const Piece& piece, const Corners& triangle) {
  double low = std::numeric_limits<double>::infinity();
  for (const Place& corner : piece) low = std::min(low, line.dot(corner.at - triangle[0]));
  double high = 0;
  for (const Vec3d& corner : triangle) high = std::max(high, line.dot(corner - triangle[0]));
  return low - high;
}

// On the better of two lines: from the triangle to the piece, and at right angles to the triangle.
double gap(const Piece& piece, const Corners& triangle) {
  const Vec3d middle = 0.25 * (piece[0].at + piece[1].at + piece[2].at + piece[3].at);
  const Vec3d between = (middle - nearest_point(middle, triangle)).normalized();
  Vec3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  if (normal.dot(middle - triangle[0]) < 0) normal = -normal;
  return std::max(gap_along(between, piece, triangle), gap_along(normal, piece, triangle));
}

}  // namespace

double reach_of(const Piece& piece, std::size_t corner) {
  double squared = 0;
  for (const Place& other : piece) {
    squared = std::max(squared, (other.at - piece[corner].at).squaredNorm());
  }
  return std::sqrt(squared);
}

template <class Judge>
Proof DepthProver::prove(const Piece& piece, const Judge& judge) {
  std::vector<Piece> open = {piece};
  while (!open.empty()) {
    if (left_ == 0) return Proof::open;
    --left_;
    const Piece one = open.back();
    open.pop_back();
    const Proof proof = judge(one);
    if (proof == Proof::holds) continue;
    if (proof == Proof::fails) return proof;
    const LongestEdge edge = longest_edge(one);
    if (edge.squared == 0) return Proof::open;
    const Place middle =
        depth_.place(0.5 * one[edge.from].at + 0.5 * one[edge.to].at, one[edge.from].nearest);
    open.push_back(one);
    open.back()[edge.from] = middle;
    open.push_back(one);
    open.back()[edge.to] = middle;
  }
  return Proof::holds;
}

Proof DepthProver::is_beyond(const Piece& piece, double distance) {
  return prove(piece, [&](const Piece& one) { return judge_beyond(one, distance); });
}

Proof DepthProver::is_within(const Piece& piece, double distance) {
  return prove(piece, [&](const Piece& one) { return judge_within(one, distance); });
}

Proof DepthProver::judge_beyond(const Piece& piece, double distance) {
  double nearest = piece[0].distance, bound = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    nearest = std::min(nearest, piece[i].distance);
    bound = std::max(bound, piece[i].distance - reach_of(piece, i));
  }
  if (nearest < distance) return Proof::fails;
  const double squared = power_bound(piece);
  if (squared > 0) bound = std::max(bound, std::sqrt(squared));
  if (bound < distance) {
    const double room = kWorthShadows * distance;
    const bool is_large = !is_crowded_ && longest_edge(piece).squared > room * room;
    if (!is_large || !is_apart(piece, distance, bound)) return Proof::open;
  }
  least_ = std::min(least_, bound);
  return Proof::holds;
}

// From all triangles that may be nearer than that, if they are few.
bool DepthProver::is_apart(const Piece& piece, double distance, double& least) {
  const double room = kRoom * distance;
  Box box = box_of(piece);
  box.widen(room);
  std::size_t seen = 0;
  double found = room;  // what the box leaves out is farther
  depth_.visit([&](const Box& other) { return found >= distance && other.meets(box); },
               [&](const Corners& triangle) {
                 if (found < distance) return;
                 found = ++seen > kMostApart ? 0 : std::min(found, gap(piece, triangle));
               });
  if (seen > kMostApart && longest_edge(piece).squared < distance * distance) is_crowded_ = true;
  if (found < distance) return false;
  least = found;
  return true;
}

// The largest distance of a corner from that triangle, or one above `enough`.
double DepthProver::farthest_from(std::uint32_t triangle, const Piece& piece, double enough) const {
  double farthest = 0;
  for (const Place& corner : piece) {
    const double distance =
        corner.nearest == triangle
            ? corner.distance
            : std::sqrt(squared_distance(corner.at, depth_.triangles()[triangle]));
    farthest = std::max(farthest, distance);
    if (farthest > enough) break;
  }
  return farthest;
}

Proof DepthProver::judge_within(const Piece& piece, double distance) {
  for (std::size_t i = 0; i < 4; ++i) {
    const double bound = farthest_from(piece[i].nearest, piece, distance);
    if (bound > distance) continue;
    most_ = std::max(most_, bound);
    return Proof::holds;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if (piece[i].distance <= distance) continue;
    if (depth_.is_inside(piece[i].at)) return Proof::fails;
    if (piece[i].distance > reach_of(piece, i)) return Proof::holds;  // all of it is outside
  }
  return Proof::open;
}

}  // namespace meshrepair::internal
