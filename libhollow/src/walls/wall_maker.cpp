// SPDX-License-Identifier: MIT
#include "walls/wall_maker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <base/error.h>
#include <base/parallel.h>
#include <base/shared_progress.h>
#include <hollow/hollow_options.h>
#include <simplify/decimate.h>

#include "common/soup_box.h"
#include "common/wall_judge.h"

namespace meshrepair::internal {
namespace {

// Coordinates of the result are off by so much of the largest one at most: twice what all three
// lose in single precision, where the working grid has steps of a fourth of that.
constexpr double kRounded = 2 * 1.75 * 0x1p-24;
// Of the error, before coordinates are rounded: what is proven with no room then takes any number
// of pieces to prove again.
constexpr double kProvenFirst = 0.98;
constexpr double kMade = 0.97;  // of the error: walls are made so good that proofs have some room
constexpr int kMostRounds = 3;  // of taking triangles away, where proofs fail
constexpr double kWorthAgain = 0.9;                    // of the triangles before
constexpr std::size_t kMostPiecesOfTriangle = 200000;  // of a triangle: large ones need many
constexpr std::size_t kTrianglesPerTask = 64;
// Where the bounds that were asked for do not hold: shares of the thickness that are tried.
constexpr std::array<double, 5> kLower = {0.95, 0.9, 0.75, 0.5, 0.25};
constexpr std::array<double, 5> kHigher = {1.05, 1.1, 1.25, 1.5, 2};
constexpr double kShortest = 1e-5;  // of the size of the body: the working grid has steps of 1.5e-8

double error_of(const TriangleSoup& solid, double thickness) {
  double largest = 0;
  for (const Vec3d& point : solid.points) {
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
  }
  return std::max(kProvenFirst * kHollowError - kRounded * largest / thickness, 0.5 * kHollowError);
}

void join(WallMaker::Bounds& all, const WallMaker::Bounds& one) {
  all.least = std::min(all.least, one.least);
  all.most = std::max(all.most, one.most);
  all.beside += one.beside;
}

}  // namespace

void check_length(const TriangleSoup& solid, double length, const std::string& option) {
  if (length >= kShortest * longest_side(box_of(solid))) return;
  throw ValueError(option + ": less than a hundred-thousandth of the body is too small");
}

WallMaker::WallMaker(const TriangleSoup& solid, double thickness, Precision precision,
                     std::string_view option, ProgressObserver* progress)
    : solid_(solid),
      thickness_(thickness),
      precision_(precision),
      option_(option),
      progress_(progress),
      error_(error_of(solid, thickness)),
      depth_(solid) {}

Cavities WallMaker::find() const {
  CavityOptions options;
  options.thickness = thickness_;
  options.error = kMade * error_ * thickness_;
  options.option = option_;
  options.progress = progress_;
  return find_cavities(solid_, depth_, options);
}

// What a collapse refuses, others may allow later.
void WallMaker::take_away_triangles(Cavities& found) const {
  if (found.cavity.empty()) return;
  HalvedStage progress(progress_);
  double before = 0;
  do {
    before = static_cast<double>(found.cavity.size());
    if (!take_away_some(found, progress)) return;
  } while (found.unproven == 0 && static_cast<double>(found.cavity.size()) < kWorthAgain * before);
}

// False if nothing is. Where a triangle turns out to be less deep than that between the points that
// were looked at, those that it came from stay next time.
bool WallMaker::take_away_some(Cavities& found, HalvedStage& progress) const {
  std::vector<DecimationOptions::Stay> stays(found.walls.points.size(),
                                             DecimationOptions::Stay::no);
  for (int round = 0; round < kMostRounds; ++round) {
    DecimationOptions options;
    options.distance = kMade * error_ * thickness_;
    WallJudge judge(depth_, found.walls.points, thickness_, options.distance);
    options.judge = &judge;
    options.precision = precision_;
    options.stays = stays;
    options.progress = &progress;
    progress.begin_step();
    DecimationReport report;
    DecimatedMesh fewer = decimate(found.walls, options, report);
    const std::vector<std::uint32_t> beside = triangles_beside(fewer.mesh);
    // What was not proven before does not get better.
    if (beside.empty() || found.unproven > 0) {
      std::vector<std::uint32_t> cavity;
      cavity.reserve(fewer.source.size());
      for (const std::uint32_t t : fewer.source) cavity.push_back(found.cavity[t]);
      found.walls = std::move(fewer.mesh);
      found.cavity = std::move(cavity);
      return true;
    }
    std::vector<char> is_beside(fewer.mesh.points.size(), 0);
    for (const std::uint32_t t : beside) {
      for (const std::uint32_t point : fewer.mesh.triangles[t]) is_beside[point] = 1;
    }
    for (std::size_t i = 0; i < stays.size(); ++i) {
      if (is_beside[fewer.point[i]] != 0) stays[i] = DecimationOptions::Stay::alone;
    }
  }
  return false;
}

// For which the bounds that were asked for are not proven.
std::vector<std::uint32_t> WallMaker::triangles_beside(const TriangleSoup& walls) const {
  std::vector<char> beside(walls.triangles.size(), 0);
  CancelOnly quiet(progress_);
  SharedProgress polled(&quiet, tasks_of(beside.size(), kTrianglesPerTask));
  parallel_tasks(
      beside.size(), kTrianglesPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) {
          const auto& [a, b, c] = walls.triangles[t];
          beside[t] = !holds({walls.points[a], walls.points[b], walls.points[c]}, error_);
        }
        polled.done();
      });
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < beside.size(); ++t) {
    if (beside[t] != 0) found.push_back(t);
  }
  return found;
}

Piece WallMaker::piece_of(const Triangle& triangle) const {
  Piece piece;
  piece[0] = depth_.place(triangle[0], 0);
  for (std::size_t i = 1; i < 3; ++i) piece[i] = depth_.place(triangle[i], piece[0].nearest);
  piece[3] = piece[2];
  return piece;
}

bool WallMaker::is_proven(const Piece& piece, double error, DepthProver& prover) const {
  return prover.is_beyond(piece, thickness_ * (1 - error)) == Proof::holds &&
         prover.is_within(piece, thickness_ * (1 + error)) == Proof::holds;
}

bool WallMaker::holds(const Triangle& triangle, double error) const {
  DepthProver prover(depth_, kMostPiecesOfTriangle);
  return is_proven(piece_of(triangle), error, prover);
}

WallMaker::Bounds WallMaker::bounds_of(const Triangle& triangle) const {
  const Piece piece = piece_of(triangle);
  DepthProver prover(depth_, kMostPiecesOfTriangle);
  if (is_proven(piece, kHollowError, prover)) return {prover.least(), prover.most(), 0};
  Bounds bounds;
  bounds.beside = 1;
  bounds.least = 0;
  for (const double share : kLower) {
    DepthProver again(depth_, kMostPiecesOfTriangle);
    if (again.is_beyond(piece, share * thickness_) != Proof::holds) continue;
    bounds.least = again.least();
    break;
  }
  bounds.most = std::numeric_limits<double>::infinity();
  for (const double share : kHigher) {
    DepthProver again(depth_, kMostPiecesOfTriangle);
    if (again.is_within(piece, share * thickness_) != Proof::holds) continue;
    bounds.most = again.most();
    break;
  }
  return bounds;
}

WallMaker::Bounds WallMaker::measure(const TriangleSoup& mesh,
                                     std::span<const std::uint32_t> triangles) const {
  SharedProgress shared(progress_, tasks_of(triangles.size(), kTrianglesPerTask));
  const auto reduce = [&](std::size_t first, std::size_t last) {
    Bounds all;
    for (std::size_t i = first; i < last; ++i) {
      const auto& [a, b, c] = mesh.triangles[triangles[i]];
      join(all, bounds_of({mesh.points[a], mesh.points[b], mesh.points[c]}));
    }
    shared.done();
    return all;
  };
  return parallel_reduce(triangles.size(), kTrianglesPerTask, reduce, join);
}

}  // namespace meshrepair::internal
