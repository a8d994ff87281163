// The distance to one triangle t of the other mesh is a convex function of the point, so over a
// piece of a triangle it is largest in a corner of the piece, and the distance to the other mesh is
// nowhere larger than the largest of the three corners' distances to t. Any t gives a bound; good
// ones are those nearest to the piece's middle and to its corners. Besides, no point is farther
// than the middle by more than it is away from the middle.
//
// Pieces whose bound is not good enough are cut into four by the middles of their sides. In rounds,
// the worst pieces first, so that the bound falls as far as the allowed work takes it; a round is
// the same however many threads share it.
#include "distance_bound.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include <bsp/shared_progress.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kPiecesPerTask = 512;
// Middles are rounded by at most one unit in the last place of the largest coordinate, 2^-53 of it,
// in each of three coordinates: a point of a piece is by 2^-52 of it beside its parent, for each of
// at most kMostLevels cuts. A distance is rounded by a few units in the last place of a sum of
// coordinates, and in proportion.
constexpr int kMostLevels = 60;
constexpr double kCoordinateRounding = (2 * kMostLevels + 64) * 0x1p-53;
constexpr double kDistanceRounding = 1 + 16 * 0x1p-53;

struct Piece {
  Corners corners;
  std::uint32_t hint = 0;  // a triangle near it
  int level = 0;
  double bound = 0;
};

// Fills in hint and bound; returns the distance of the piece's middle.
double examine(Piece& piece, const NearestTriangle& to) {
  const auto& [a, b, c] = piece.corners;
  const Vec3d middle = a / 3 + b / 3 + c / 3;
  const Nearest nearest = to.find(middle, piece.hint);
  const double distance = std::sqrt(nearest.squared_distance);
  double radius = 0;
  for (const Vec3d& corner : piece.corners) {
    radius = std::max(radius, (corner - middle).squaredNorm());
  }
  piece.hint = nearest.triangle;
  piece.bound = distance + std::sqrt(radius);
  const auto try_triangle = [&](std::uint32_t t) {
    double largest = 0;
    for (const Vec3d& corner : piece.corners) {
      largest = std::max(largest, squared_distance(corner, to.triangles()[t]));
    }
    piece.bound = std::min(piece.bound, std::sqrt(largest));
  };
  try_triangle(nearest.triangle);
  if (piece.bound <= distance) return distance;
  for (const Vec3d& corner : piece.corners) {
    const std::uint32_t t = to.find(corner, piece.hint).triangle;
    if (t != piece.hint) try_triangle(t);
  }
  return distance;
}

std::array<Piece, 4> cut(const Piece& piece) {
  const auto& [a, b, c] = piece.corners;
  const Vec3d ab = 0.5 * a + 0.5 * b, bc = 0.5 * b + 0.5 * c, ca = 0.5 * c + 0.5 * a;
  const std::array<Corners, 4> parts = {{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}};
  std::array<Piece, 4> pieces;
  for (std::size_t i = 0; i < 4; ++i) pieces[i] = {parts[i], piece.hint, piece.level + 1, 0};
  return pieces;
}

class Bounder {
 public:
  Bounder(const NearestTriangle& to, const BoundOptions& options)
      : to_(to), options_(options), known_(options.known) {}

  double run(const std::vector<Corners>& from) {
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
    const std::size_t tasks = (pieces.size() + kPiecesPerTask - 1) / kPiecesPerTask;
    std::vector<double> found(tasks, 0);
    SharedProgress shared(&quiet_, tasks);
    quiet_.observer = options_.progress;
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
      const std::size_t end = std::min(pieces.size(), (task + 1) * kPiecesPerTask);
      for (std::size_t i = task * kPiecesPerTask; i < end; ++i) {
        found[task] = std::max(found[task], examine(pieces[i], to_));
      }
      shared.done();
    });
    for (const double distance : found) known_ = std::max(known_, distance);
    examined_ += pieces.size();
    if (options_.progress != nullptr && options_.most_pieces > 0) {
      options_.progress->advance(std::min(
          1.0, static_cast<double>(examined_) / static_cast<double>(options_.most_pieces)));
    }
  }

  [[nodiscard]] double rounding() const { return options_.magnitude * kCoordinateRounding; }

  // Pieces that are good enough, or as good as rounding allows, are done with.
  void keep_open(const std::vector<Piece>& pieces) {
    open_.insert(open_.end(), pieces.begin(), pieces.end());
    const double enough = std::max(options_.factor * known_, rounding());
    std::erase_if(open_, [&](const Piece& piece) {
      const bool done = piece.bound <= enough || piece.level >= kMostLevels;
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
    if (examined_ + 4 * bad > options_.most_pieces) return fresh;
    for (const Piece& piece : open_) {
      if (!is_bad(piece)) continue;
      for (const Piece& part : cut(piece)) fresh.push_back(part);
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

double distance_bound(const std::vector<Corners>& from, const NearestTriangle& to,
                      const BoundOptions& options) {
  return Bounder(to, options).run(from);
}

}  // namespace meshrepair::internal
