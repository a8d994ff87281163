// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include <base/error.h>
#include <base/parallel.h>
#include <base/shared_progress.h>
#include <base/stage_meter.h>
#include <boolean/boolean.h>
#include <hollow/hollow.h>
#include <mesh/append_soup.h>
#include <mesh/mesh_parts.h>
#include <mesh/topology.h>
#include <simplify/decimate.h>

#include "common/depth.h"
#include "common/prove_depth.h"
#include "common/wall_judge.h"
#include "drains/place_drains.h"
#include "walls/find_cavities.h"

namespace meshrepair {
namespace {

using internal::Cavities;
using internal::CavityPlaces;
using internal::Depth;
using internal::DepthProver;
using internal::DrainPlacer;
using internal::Drill;
using internal::Piece;
using internal::Place;
using internal::Proof;

// Coordinates of the result are off by so much of the largest one at most: twice what all three
// lose in single precision, where the working grid has steps of a fourth of that.
constexpr double kRounded = 2 * 1.75 * 0x1p-24;
// Of the error, before coordinates are rounded: what is proven with no room then takes any number
// of pieces to prove again.
constexpr double kProvenFirst = 0.98;
constexpr double kMade = 0.97;  // of the error: walls are made so good that proofs have some room
constexpr int kMostRounds = 3;  // of taking triangles away
constexpr double kLeastBall = 0.25;          // of the wall, that a cavity holds
constexpr std::size_t kMostPieces = 200000;  // of a triangle: large ones need many
constexpr std::size_t kTrianglesPerTask = 64;
// Where the bounds that were asked for do not hold: shares of the thickness that are tried.
constexpr std::array<double, 5> kLower = {0.95, 0.9, 0.75, 0.5, 0.25};
constexpr std::array<double, 5> kHigher = {1.05, 1.1, 1.25, 1.5, 2};
constexpr double kThinnest = 1e-5;  // of the size of the body: the working grid has steps of 1.5e-8

double longest_side(const TriangleSoup& soup) {
  Vec3d low = soup.points[0], high = low;
  for (const Vec3d& point : soup.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).maxCoeff();
}

// Of the thickness, that walls may be off before their coordinates are rounded.
double error_of(const TriangleSoup& solid, const HollowOptions& options) {
  double largest = 0;
  for (const Vec3d& point : solid.points) {
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
  }
  return std::max(kProvenFirst * kHollowError - kRounded * largest / options.wall,
                  0.5 * kHollowError);
}

class Hollower {
 public:
  Hollower(const Surface& solid, const HollowOptions& options, const RepairOptions& repair,
           HollowReport& hollowed, RepairReport& report)
      : solid_(solid),
        options_(options),
        repair_(repair),
        hollowed_(hollowed),
        report_(report),
        error_(error_of(solid.mesh, options)),
        depth_(solid.mesh),
        meter_(report.stages, repair.progress) {}

  Surface run() {
    hollowed_ = {};
    hollowed_.wall = options_.wall;
    hollowed_.drain = options_.drain;
    hollowed_.volume_before = signed_volume(solid_.mesh);
    meter_.begin("cavities");
    find();
    note_places();
    meter_.begin("fewer");
    take_away_triangles();
    keep_large();
    if (hollowed_.cavities.empty()) return solid_;
    meter_.begin("drains");
    if (options_.drain > 0) place_drains();
    meter_.begin("subtract");
    Surface result = subtract();
    meter_.begin("walls");
    measure(result);
    look_for_voids(result);
    name_sources(result);
    return result;
  }

 private:
  void find() {
    internal::CavityOptions options;
    options.thickness = options_.wall;
    options.error = kMade * error_ * options_.wall;
    options.progress = repair_.progress;
    found_ = internal::find_cavities(solid_.mesh, depth_, options);
    hollowed_.cells = found_.cells;
    hollowed_.finest = std::isfinite(found_.finest) ? found_.finest : 0;
    hollowed_.unproven = found_.unproven;
  }

  // Drains are looked for where tetrahedra are: later there are few corners.
  void note_places() {
    all_places_.resize(found_.deepest.size());
    for (std::size_t c = 0; c < found_.deepest.size(); ++c) {
      all_places_[c].deepest = found_.deepest[c];
    }
    if (options_.drain == 0) return;
    std::vector<char> is_noted(found_.walls.points.size(), 0);
    for (std::size_t t = 0; t < found_.cavity.size(); ++t) {
      CavityPlaces& places = all_places_[found_.cavity[t]];
      const auto& points = found_.walls.points;
      const auto& [a, b, c] = found_.walls.triangles[t];
      places.triangles.push_back({points[a], points[b], points[c]});
      for (const std::uint32_t point : {a, b, c}) {
        if (std::exchange(is_noted[point], 1) != 0) continue;
        places.corners.push_back(depth_.place(points[point], places.deepest.nearest));
      }
    }
  }

  // Where tetrahedra are small, most triangles lie in one plane. Where a triangle turns out to be
  // less deep than that between the points that were looked at, those that it came from stay next
  // time.
  void take_away_triangles() {
    if (found_.cavity.empty()) return;
    HalvedStage progress(repair_.progress);
    std::vector<DecimationOptions::Stay> stays(found_.walls.points.size(),
                                               DecimationOptions::Stay::no);
    for (int round = 0; round < kMostRounds; ++round) {
      DecimationOptions options;
      options.distance = kMade * error_ * options_.wall;
      internal::WallJudge judge(depth_, found_.walls.points, options_.wall, options.distance);
      options.judge = &judge;
      options.precision = repair_.certify.precision;
      options.stays = stays;
      options.progress = &progress;
      progress.begin_step();
      DecimationReport report;
      DecimatedMesh fewer = decimate(found_.walls, options, report);
      std::vector<char> is_beside(fewer.mesh.points.size(), 0);
      const std::vector<std::uint32_t> beside = triangles_beside(fewer.mesh);
      // What was not proven before does not get better.
      if (beside.empty() || found_.unproven > 0) return take(std::move(fewer));
      for (const std::uint32_t t : beside) {
        for (const std::uint32_t point : fewer.mesh.triangles[t]) is_beside[point] = 1;
      }
      for (std::size_t i = 0; i < stays.size(); ++i) {
        if (is_beside[fewer.point[i]] != 0) stays[i] = DecimationOptions::Stay::alone;
      }
    }
  }

  void take(DecimatedMesh&& fewer) {
    std::vector<std::uint32_t> cavity;
    for (const std::uint32_t t : fewer.source) cavity.push_back(found_.cavity[t]);
    found_.walls = std::move(fewer.mesh);
    found_.cavity = std::move(cavity);
  }

  // For which the bounds that were asked for are not proven.
  [[nodiscard]] std::vector<std::uint32_t> triangles_beside(const TriangleSoup& walls) const {
    std::vector<char> beside(walls.triangles.size(), 0);
    CancelOnly quiet(repair_.progress);
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

  // Numbers cavities anew, and drops the triangles of those that stay full.
  void keep_large() {
    const std::size_t count = found_.deepest.size();
    std::vector<TriangleSoup> walls(count);
    for (std::size_t t = 0; t < found_.cavity.size(); ++t) {
      walls[found_.cavity[t]].triangles.push_back(found_.walls.triangles[t]);
    }
    const double least = std::max(options_.drain, kLeastBall * options_.wall);
    hollowed_.least_diameter = least;
    for (std::size_t c = 0; c < count; ++c) {
      walls[c] = without_others(walls[c].triangles);
      Cavity cavity;
      cavity.volume = signed_volume(walls[c]);
      cavity.diameter = 2 * (found_.deepest[c].distance - options_.wall);
      if (cavity.diameter < least) {
        ++hollowed_.left_full;
        hollowed_.left_full_volume += cavity.volume;
        continue;
      }
      hollowed_.cavities.push_back(cavity);
      places_.push_back(std::move(all_places_[c]));
      cavity_of_wall_.insert(cavity_of_wall_.end(), walls[c].triangles.size(),
                             static_cast<std::uint32_t>(hollowed_.cavities.size() - 1));
      append_soup(walls_, walls[c]);
    }
    found_ = {};
    all_places_.clear();
  }

  // With the points that these have.
  [[nodiscard]] TriangleSoup without_others(
      const std::vector<std::array<std::uint32_t, 3>>& triangles) const {
    TriangleSoup soup;
    std::vector<std::uint32_t> points;
    for (const auto& triangle : triangles)
      points.insert(points.end(), triangle.begin(), triangle.end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const std::uint32_t point : points) soup.points.push_back(found_.walls.points[point]);
    for (auto triangle : triangles) {
      for (std::uint32_t& corner : triangle) {
        corner = static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), corner) -
                                            points.begin());
      }
      soup.triangles.push_back(triangle);
    }
    return soup;
  }

  void place_drains() {
    const DrainPlacer placer(solid_.mesh, depth_, options_);
    for (std::size_t i = 0; i < options_.drains_at.size(); ++i) add_drain_at(i, placer);
    for (std::size_t c = 0; c < places_.size(); ++c) {
      if (!hollowed_.cavities[c].drains.empty()) continue;
      for (const Drill& drill : placer.for_cavity(places_[c], drills_)) add(drill, c);
    }
  }

  // The drills before are those of the points before.
  void add_drain_at(std::size_t number, const DrainPlacer& placer) {
    const Vec3d& point = options_.drains_at[number];
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < places_.size(); ++c) {
      const double distance = placer.distance(point, places_[c]);
      if (distance >= least) continue;
      least = distance;
      nearest = c;
    }
    const auto drill = placer.from_point(point, places_[nearest], drills_);
    for (std::size_t other = 0; drill && other < drills_.size(); ++other) {
      if (placer.between(*drill, drills_[other]) > 0) continue;
      throw ValueError("--drain-at: the drains at " + name_of(other) + " and " + name_of(number) +
                       " overlap; places farther from each other or a smaller diameter may do");
    }
    if (!drill || drill->drain.beside <= 0) {
      throw ValueError("--drain-at: at " + name_of(number) +
                       ", no drain of this diameter leads from the surface into a cavity without "
                       "breaking out beside its mouth; another place or a smaller diameter may do");
    }
    add(*drill, nearest);
  }

  [[nodiscard]] std::string name_of(std::size_t point) const {
    if (point < options_.drain_names.size()) return options_.drain_names[point];
    return "point " + std::to_string(point + 1);
  }

  void add(const Drill& drill, std::size_t cavity) {
    double& least = hollowed_.beside_drains;
    least = drills_.empty() ? drill.drain.beside : std::min(least, drill.drain.beside);
    hollowed_.cavities[cavity].drains.push_back(drill.drain);
    drills_.push_back(drill);
  }

  Surface subtract() {
    std::vector<TriangleSoup> solids = {solid_.mesh, walls_};
    for (const Drill& drill : drills_) solids.push_back(internal::prism_of(drill, options_.drain));
    CancelOnly quiet(repair_.progress);
    BooleanOptions options;
    options.repair = repair_;
    options.repair.progress = &quiet;
    options.repair.join_gaps = {};
    options.repair.keep = {};
    options.repair.fewer = {};
    options.repair.reach = {};
    options.repair.opacity = {};
    options.repair.states = nullptr;
    options.repair.explain = false;
    options.repair.examine = nullptr;
    BooleanReport told;
    Surface result = boolean(solids, SetOperation::subtract, options, told);
    report_.certify = told.result.certify;
    report_.output = told.result.output;
    report_.output_volume = told.result.output_volume;
    report_.output_area = told.result.output_area;
    report_.spared_cells |= std::exchange(report_.kept_valid, false);
    report_.same_triangles = false;
    count_drilled(result);
    return result;
  }

  // Triangles that drains go through are whole no more.
  void count_drilled(const Surface& result) {
    const std::vector<IndexTriangle>& given = solid_.mesh.triangles;
    std::vector<char> is_whole(given.size(), 0);
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
      const std::uint32_t source = result.source[t];
      if (source == Surface::kNoSource || source >= given.size()) continue;
      const auto is_corner = [&](std::uint32_t p) {
        return std::any_of(given[source].begin(), given[source].end(), [&](std::uint32_t q) {
          return solid_.mesh.points[q] == result.mesh.points[p];
        });
      };
      const IndexTriangle& corners = result.mesh.triangles[t];
      if (std::all_of(corners.begin(), corners.end(), is_corner)) is_whole[source] = 1;
    }
    TriangleFates& fates = report_.triangles;
    const auto drilled = static_cast<std::size_t>(std::count(is_whole.begin(), is_whole.end(), 0));
    const std::size_t changed = std::min(drilled, fates.untouched);
    fates.untouched -= changed;
    fates.cut += changed;
  }

  // Of a triangle of the result, the cavity whose wall it is a part of.
  [[nodiscard]] std::uint32_t cavity_of(std::uint32_t source) const {
    const std::size_t first = solid_.mesh.triangles.size();
    if (source == Surface::kNoSource || source < first) return kNoCavity;
    return source - first < cavity_of_wall_.size() ? cavity_of_wall_[source - first] : kNoCavity;
  }

  struct Bounds {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    std::size_t beside = 0;  // triangles for which what was asked for is not proven
  };

  [[nodiscard]] Piece piece_of(const std::array<Vec3d, 3>& triangle) const {
    Piece piece;
    piece[0] = depth_.place(triangle[0], 0);
    for (std::size_t i = 1; i < 3; ++i) piece[i] = depth_.place(triangle[i], piece[0].nearest);
    piece[3] = piece[2];
    return piece;
  }

  [[nodiscard]] bool is_proven(const Piece& piece, double error, DepthProver& prover) const {
    return prover.is_beyond(piece, options_.wall * (1 - error)) == Proof::holds &&
           prover.is_within(piece, options_.wall * (1 + error)) == Proof::holds;
  }

  [[nodiscard]] bool holds(const std::array<Vec3d, 3>& triangle, double error) const {
    DepthProver prover(depth_, kMostPieces);
    return is_proven(piece_of(triangle), error, prover);
  }

  [[nodiscard]] Bounds bounds_of(const std::array<Vec3d, 3>& triangle) const {
    const Piece piece = piece_of(triangle);
    const double wall = options_.wall;
    DepthProver prover(depth_, kMostPieces);
    if (is_proven(piece, kHollowError, prover)) return {prover.least(), prover.most(), 0};
    Bounds bounds;
    bounds.beside = 1;
    bounds.least = 0;
    for (const double share : kLower) {
      DepthProver again(depth_, kMostPieces);
      if (again.is_beyond(piece, share * wall) != Proof::holds) continue;
      bounds.least = again.least();
      break;
    }
    bounds.most = std::numeric_limits<double>::infinity();
    for (const double share : kHigher) {
      DepthProver again(depth_, kMostPieces);
      if (again.is_within(piece, share * wall) != Proof::holds) continue;
      bounds.most = again.most();
      break;
    }
    return bounds;
  }

  // On the coordinates of the result.
  void measure(const Surface& result) {
    std::vector<std::uint32_t> walls;
    for (std::uint32_t t = 0; t < result.source.size(); ++t) {
      if (cavity_of(result.source[t]) != kNoCavity) walls.push_back(t);
    }
    SharedProgress shared(repair_.progress, tasks_of(walls.size(), kTrianglesPerTask));
    const auto reduce = [&](std::size_t first, std::size_t last) {
      Bounds all;
      for (std::size_t i = first; i < last; ++i) {
        const auto& [a, b, c] = result.mesh.triangles[walls[i]];
        join(all, bounds_of({result.mesh.points[a], result.mesh.points[b], result.mesh.points[c]}));
      }
      shared.done();
      return all;
    };
    const Bounds all = parallel_reduce(walls.size(), kTrianglesPerTask, reduce, join);
    hollowed_.least = all.least;
    hollowed_.most = all.most;
    hollowed_.unproven += all.beside;
  }

  static void join(Bounds& all, const Bounds& one) {
    all.least = std::min(all.least, one.least);
    all.most = std::max(all.most, one.most);
    all.beside += one.beside;
  }

  // A void that is closed has a component of its own around it, turned inward.
  void look_for_voids(const Surface& result) {
    TopologyPlaces places;
    const auto& triangles = result.mesh.triangles;
    const Topology topology = examine_topology(triangles, result.mesh.points.size(), &places);
    const std::vector<PartSize> sizes =
        part_sizes(result.mesh.points, triangles, places.parts,
                   static_cast<std::uint32_t>(topology.parts), UnitScale(result.mesh.points));
    for (Cavity& cavity : hollowed_.cavities) cavity.opens = true;
    for (std::uint32_t t = 0; t < result.source.size(); ++t) {
      const std::uint32_t cavity = cavity_of(result.source[t]);
      if (cavity != kNoCavity && sizes[places.parts[t]].volume < 0) {
        hollowed_.cavities[cavity].opens = false;
      }
    }
  }

  // Of walls there are none.
  void name_sources(Surface& result) const {
    for (std::uint32_t& source : result.source) {
      if (source >= solid_.mesh.triangles.size()) source = Surface::kNoSource;
    }
  }

  static constexpr std::uint32_t kNoCavity = ~std::uint32_t{0};

  const Surface& solid_;
  const HollowOptions& options_;
  const RepairOptions& repair_;
  HollowReport& hollowed_;
  RepairReport& report_;
  const double error_;
  Depth depth_;
  StageMeter meter_;
  Cavities found_;
  TriangleSoup walls_;  // of all cavities that are made
  std::vector<std::uint32_t> cavity_of_wall_;
  std::vector<CavityPlaces> all_places_, places_;  // also of those that stay full
  std::vector<Drill> drills_;
};

void check(const Surface& solid, const HollowOptions& options) {
  if (!(options.wall > 0) || !std::isfinite(options.wall)) {
    throw UsageError("--hollow: the wall needs a thickness above 0");
  }
  if (!(options.drain >= 0) || !std::isfinite(options.drain)) {
    throw UsageError("--drain: a diameter is above 0");
  }
  if (!options.drains_at.empty() && options.drain == 0) {
    throw UsageError("--drain-at: drains need a diameter, by --drain");
  }
  const double thinnest = kThinnest * longest_side(solid.mesh);
  if (options.drain > 0 && options.drain < thinnest) {
    throw ValueError(
        "--drain: a diameter of less than a hundred-thousandth of the body is too small");
  }
  if (options.wall < thinnest) {
    throw ValueError("--hollow: a wall of less than a hundred-thousandth of the body is too thin");
  }
}

}  // namespace

Surface hollow(const Surface& solid, const HollowOptions& options, const RepairOptions& repair,
               HollowReport& hollowed, RepairReport& report) {
  check(solid, options);
  return Hollower(solid, options, repair, hollowed, report).run();
}

}  // namespace meshrepair
