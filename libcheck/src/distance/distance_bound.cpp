// SPDX-License-Identifier: MIT
// The distance to one triangle t of the other mesh is a convex function of the point, so over a
// piece of a triangle it is largest in a corner of the piece, and the distance to the other mesh is
// nowhere larger than the largest of the three corners' distances to t. Any t gives a bound; good
// ones are those nearest to the piece's middle and to its corners. Besides, no point is farther
// than the middle by more than it is away from the middle.
//
// Pieces whose bound is not good enough are cut: what lies over t is taken away if it is good
// enough by itself and a fair share of the piece, so that meshes with the same surface and other
// triangles come apart into common pieces soon; else into four by the middles of the sides. This
// goes in rounds, the worst pieces first, so that the bound falls as far as the allowed work takes
// it; a round is the same however many threads share it.
#include "distance_bound.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include <base/parallel.h>
#include <base/shared_progress.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kPiecesPerTask = 512;
// A corner that a cut makes is rounded by less than 4 units of 2^-53 of the largest coordinate in
// each of three coordinates: a point of a piece is by 8 of them beside its parent, for each of at
// most three cuts in each of at most kMostLevels levels. A distance is rounded by a few units in
// the last place of a sum of coordinates, and in proportion.
constexpr int kMostLevels = 80;
constexpr double kCoordinateRounding = (24 * kMostLevels + 64) * 0x1p-53;
constexpr double kDistanceRounding = 1 + 16 * 0x1p-53;
// What is cut into more pieces than so many for each triangle of both, on the average, is given up.
constexpr std::size_t kPiecesOfEach = 256;
// Less of a piece is not worth taking away: it would leave slivers.
constexpr double kFairShare = 0.125;
// What lies beside a triangle by less than this share of the distance that is good enough is taken
// away with it: slivers along its sides would come back for ever, at sharp corners excepted.
constexpr double kMargin = 0.125;

struct Piece {
  Corners corners;
  std::uint32_t hint = 0;  // a triangle near it
  int level = 0;
  std::uint32_t origin = 0;  // the triangle that it is a piece of
  double bound = 0;
};

double farthest_corner(const Piece& piece, const Corners& triangle) {
  double largest = 0;
  for (const Vec3d& corner : piece.corners) {
    largest = std::max(largest, squared_distance(corner, triangle));
  }
  return std::sqrt(largest);
}

// Fills in hint and bound, by the triangle that is nearest to the piece's middle; returns the
// distance of that.
double examine_middle(Piece& piece, const NearestTriangle& to) {
  const auto& [a, b, c] = piece.corners;
  const Vec3d middle = a / 3 + b / 3 + c / 3;
  const Nearest nearest = to.find(middle, piece.hint);
  const double distance = std::sqrt(nearest.squared_distance);
  double radius = 0;
  for (const Vec3d& corner : piece.corners) {
    radius = std::max(radius, (corner - middle).squaredNorm());
  }
  piece.hint = nearest.triangle;
  piece.bound =
      std::min(distance + std::sqrt(radius), farthest_corner(piece, to.triangles()[piece.hint]));
  return distance;
}

// The same by those that are nearest to its corners, too.
double examine(Piece& piece, const NearestTriangle& to) {
  const double distance = examine_middle(piece, to);
  if (piece.bound <= distance) return distance;
  for (const Vec3d& corner : piece.corners) {
    const std::uint32_t t = to.find(corner, piece.hint).triangle;
    if (t == piece.hint) continue;
    piece.bound = std::min(piece.bound, farthest_corner(piece, to.triangles()[t]));
  }
  return distance;
}

void add_piece(const Piece& whole, const Corners& corners, std::vector<Piece>& pieces) {
  pieces.push_back({corners, whole.hint, whole.level + 1, whole.origin, 0});
}

void cut_at_middles(const Piece& piece, std::vector<Piece>& pieces) {
  const auto& [a, b, c] = piece.corners;
  const Vec3d ab = 0.5 * a + 0.5 * b, bc = 0.5 * b + 0.5 * c, ca = 0.5 * c + 0.5 * a;
  add_piece(piece, {a, ab, ca}, pieces);
  add_piece(piece, {ab, b, bc}, pieces);
  add_piece(piece, {ca, bc, c}, pieces);
  add_piece(piece, {bc, ca, ab}, pieces);
}

// Convex, in the plane of a piece.
struct Polygon {
  std::array<Vec3d, 8> corners;  // a triangle that is cut three times in two has six at most
  std::size_t count = 0;

  void add(const Vec3d& p) { corners[count++] = p; }

  [[nodiscard]] double area() const {
    Vec3d sum = Vec3d::Zero();
    for (std::size_t i = 2; i < count; ++i) {
      sum += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
    }
    return 0.5 * sum.norm();
  }
};

struct Halves {
  Polygon inner, outer;
  int crossings = 0;  // more than 2: by rounding the plane crosses a sliver several times
};

// By the plane through `origin` with this normal, which points to the outer half.
Halves split(const Polygon& polygon, const Vec3d& origin, const Vec3d& outward) {
  Halves halves;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3d& p = polygon.corners[i];
    const Vec3d& q = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
    const double p_beyond = (p - origin).dot(outward), q_beyond = (q - origin).dot(outward);
    (p_beyond > 0 ? halves.outer : halves.inner).add(p);
    if ((p_beyond > 0) == (q_beyond > 0)) continue;
    if (++halves.crossings > 2) break;
    const double share = std::clamp(p_beyond / (p_beyond - q_beyond), 0.0, 1.0);
    const Vec3d crossing = p + share * (q - p);
    halves.inner.add(crossing);
    halves.outer.add(crossing);
  }
  return halves;
}

// Takes away what of the piece lies over the triangle, made larger by a margin all around, if no
// point of that is farther from it than `enough`, and it is a fair share; the rest is appended to
// `pieces`. Returns the distance of what was taken away, or a negative number if the piece is left
// whole.
double take_away(const Piece& piece, const Corners& triangle, double enough, double margin,
                 std::vector<Piece>& pieces) {
  const std::size_t before = pieces.size();
  const Vec3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  Polygon inner;
  for (const Vec3d& corner : piece.corners) inner.add(corner);
  const double fair = kFairShare * inner.area();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d outward = (triangle[(k + 1) % 3] - triangle[k]).cross(normal).stableNormalized();
    const Halves halves = split(inner, triangle[k] + margin * outward, outward);
    if (halves.crossings > 2) {
      pieces.resize(before);
      return -1;
    }
    for (std::size_t i = 2; i < halves.outer.count; ++i) {
      const auto& corners = halves.outer.corners;
      add_piece(piece, {corners[0], corners[i - 1], corners[i]}, pieces);
    }
    inner = halves.inner;
  }
  double farthest = 0;
  for (std::size_t i = 0; i < inner.count; ++i) {
    farthest = std::max(farthest, squared_distance(inner.corners[i], triangle));
  }
  farthest = std::sqrt(farthest);
  if (inner.count >= 3 && fair > 0 && inner.area() >= fair && farthest <= enough) return farthest;
  pieces.resize(before);
  return -1;
}

// Every fourth level makes the pieces smaller for sure: to take away much of the area may leave a
// long rest. Returns the distance of what was taken away, or a negative number.
double cut(const Piece& piece, const NearestTriangle& to, double enough,
           std::vector<Piece>& pieces) {
  double taken = -1;
  if (piece.level % 4 != 3) {
    const Corners& triangle = to.triangles()[piece.hint];
    taken = take_away(piece, triangle, enough, kMargin * enough, pieces);
    if (taken < 0) taken = take_away(piece, triangle, enough, 0, pieces);
  }
  if (taken < 0) cut_at_middles(piece, pieces);
  return taken;
}

double rounding_of(double magnitude) { return magnitude * kCoordinateRounding; }

class Bounder {
 public:
  Bounder(const NearestTriangle& to, const BoundOptions& options)
      : to_(to), options_(options), known_(options.known) {}

  double run(std::span<const Corners> from) {
    std::vector<Piece> fresh(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) fresh[i].corners = from[i];
    while (!fresh.empty()) {
      examine_all(fresh);
      keep_open(fresh);
      fresh = cut_worst();
    }
    for (const Piece& piece : open_) settled_ = std::max(settled_, piece.bound);
    return settled_ * kDistanceRounding + rounding();
  }

 private:
  void examine_all(std::vector<Piece>& pieces) {
    SharedProgress shared(&quiet_, tasks_of(pieces.size(), kPiecesPerTask));
    quiet_.observer = options_.progress;
    const auto largest_of = [&](std::size_t first, std::size_t last) {
      double largest = 0;
      for (std::size_t i = first; i < last; ++i) {
        largest = std::max(largest, examine(pieces[i], to_));
      }
      shared.done();
      return largest;
    };
    const double found =
        parallel_reduce(pieces.size(), kPiecesPerTask, largest_of,
                        [](double& all, double part) { all = std::max(all, part); });
    known_ = std::max(known_, found);
    examined_ += pieces.size();
    if (options_.progress != nullptr && options_.most_pieces > 0) {
      options_.progress->advance(std::min(
          1.0, static_cast<double>(examined_) / static_cast<double>(options_.most_pieces)));
    }
  }

  [[nodiscard]] double rounding() const { return rounding_of(options_.magnitude); }
  [[nodiscard]] double enough() const { return std::max(options_.factor * known_, rounding()); }

  // Pieces that are good enough, or as good as rounding allows, are done with.
  void keep_open(const std::vector<Piece>& pieces) {
    open_.insert(open_.end(), pieces.begin(), pieces.end());
    const double good = enough();
    std::erase_if(open_, [&](const Piece& piece) {
      const bool done = piece.bound <= good || piece.level >= kMostLevels;
      if (done) settled_ = std::max(settled_, piece.bound);
      return done;
    });
  }

  std::vector<Piece> cut_worst() {
    double worst = 0;
    for (const Piece& piece : open_) worst = std::max(worst, piece.bound);
    std::vector<Piece> fresh;
    // What is settled with a large bound cannot be made better by the rest.
    if (worst <= settled_) return fresh;
    const double threshold = std::max(worst / 2, settled_);
    const auto is_bad = [&](const Piece& piece) { return piece.bound > threshold; };
    const auto bad = static_cast<std::size_t>(std::count_if(open_.begin(), open_.end(), is_bad));
    if (examined_ + 5 * bad > options_.most_pieces) return fresh;
    for (const Piece& piece : open_) {
      if (!is_bad(piece)) continue;
      settled_ = std::max(settled_, cut(piece, to_, enough(), fresh));
    }
    std::erase_if(open_, is_bad);
    return fresh;
  }

  // Asks for the caller whether to stop; a round is no measure of the whole.
  class Asker : public ProgressObserver {
   public:
    bool cancelled() override { return observer != nullptr && observer->cancelled(); }
    ProgressObserver* observer = nullptr;
  };

  const NearestTriangle& to_;
  const BoundOptions& options_;
  Asker quiet_;
  std::vector<Piece> open_;
  double known_;
  double settled_ = 0;
  std::size_t examined_ = 0;
};

}  // namespace

double distance_bound(std::span<const Corners> from, const NearestTriangle& to,
                      const BoundOptions& options) {
  return Bounder(to, options).run(from);
}

std::vector<char> are_beyond(std::span<const Corners> from, const NearestTriangle& to,
                             double distance, double magnitude, ProgressObserver* progress) {
  const double most = (distance - rounding_of(magnitude)) / kDistanceRounding;
  std::vector<char> beyond(from.size(), 0);
  std::vector<Piece> pieces(from.size()), fresh;
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    pieces[i].corners = from[i];
    pieces[i].origin = i;
  }
  CancelCheck check(progress);
  std::size_t left = kPiecesOfEach * (from.size() + to.triangles().size());
  while (!pieces.empty()) {
    const bool is_last = pieces.size() > left;
    left -= std::min(left, pieces.size());
    std::vector<double> of_middle(pieces.size());
    parallel_tasks(pieces.size(), kPiecesPerTask,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       Piece& piece = pieces[i];
                       if (piece.level == 0 && i > first) piece.hint = pieces[i - 1].hint;
                       piece.bound = farthest_corner(piece, to.triangles()[piece.hint]);
                       if (piece.bound > most) of_middle[i] = examine_middle(piece, to);
                     }
                   });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const bool is_hopeless = pieces[i].level >= kMostLevels || is_last;
      if (pieces[i].bound <= most) continue;
      if (is_hopeless || of_middle[i] > most) beyond[pieces[i].origin] = 1;
    }
    fresh.clear();
    for (const Piece& piece : pieces) {
      check.tick();
      if (beyond[piece.origin] == 0 && piece.bound > most) cut(piece, to, most, fresh);
    }
    pieces.swap(fresh);
  }
  return beyond;
}

}  // namespace meshrepair::internal
