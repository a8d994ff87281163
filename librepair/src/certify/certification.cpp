// SPDX-License-Identifier: MIT
// Certification.
//
// Every decision was exact for points on the working grid and for exact intersections of planes.
// What may fail is the rounding of those intersections, and that input points are written with
// their own coordinates, not with those of the grid. So a point at fault goes onto the grid. What
// still intersects is mended place by place, by moving points and collapsing and turning edges.
// What is left is repaired again, each group of parts that have to do with each other by itself, so
// that one bad place costs no more than its group. Where that does not do, but for a few places,
// the rounded mesh is a soup of its own: repairing it again cuts, and rounds, at these places only.
// Else the mesh is a soup of grid points, and repairing it again makes intersections only where the
// moves made some, fewer each time. A coarser grid keeps points further apart, which is why it
// ends.
#include "certification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <base/error.h>
#include <check/self_intersections.h>
#include <mesh/precision.h>
#include <mesh/topology.h>
#include <repair/certify.h>
#include <repair/internal/mend_faults.h>

#include "common/drop_thin_parts.h"
#include "faulty_groups.h"
#include "separate_copies.h"
#include "settle_points.h"

namespace meshrepair::internal {
namespace {

// More are counted but not mended in one round.
constexpr std::size_t kPairsToMend = 1'000'000;

// A coarser grid may take the solid away instead of its faults: nothing is better whose volume
// differs by more than this share, and what the surface encloses when it is moved by so many steps
// of the numbers.
constexpr double kMostLost = 0.1;
constexpr double kStepsMoved = 4;

// How far edges are collapsed or turned to mend a place, in steps of the numbers.
constexpr double kMendSteps = 16;

// Rounds of mending that bring nothing in a row, before it ends.
constexpr std::size_t kMostVain = 2;

// How often few places are repaired where they are, as long as they get fewer.
constexpr std::size_t kMostPlaces = 16;

// How often corners of few places go onto a grid, each one four times as coarse as the last.
constexpr std::size_t kMostSnaps = 3;

// Of more faults than these, and than a share of the triangles, the surface is finer than the
// numbers: neither chance nor mending place by place is a remedy for that, and both would look at
// all of them often.
constexpr std::size_t kManyFaults = 256;
constexpr std::size_t kTrianglesOfFault = 8;

// Where sheets lie closer together than the grid's steps, each round makes ever more of crossings
// that are only moved.
constexpr std::size_t kMostGrowthOfPart = 4;

using GridCell = std::array<double, 3>;

void round_points(TriangleSoup& mesh, Precision precision) {
  for (Vec3d& p : mesh.points) p = rounded_to(p, precision);
}

// They are no points of the input any more.
void forget_moved_points(Surface& surface, const std::vector<Vec3d>& before) {
  for (std::size_t p = 0; p < before.size(); ++p) {
    if (surface.mesh.points[p] != before[p]) surface.input_point[p] = 0;
  }
}

// Of a surface made again of another: the sources of that.
void name_sources(const Surface& of, Surface& again) {
  for (std::uint32_t& source : again.source) {
    if (source != Surface::kNoSource) source = of.source[source];
  }
}

// By enough to go on.
bool are_fewer(std::size_t now, std::size_t before) { return now + before / 4 < before; }

double snapped(double x, double step) { return std::nearbyint(x / step) * step; }

Vec3d snapped(const Vec3d& p, double step) {
  return {snapped(p.x(), step), snapped(p.y(), step), snapped(p.z(), step)};
}

GridCell cell_of(const Vec3d& p, double step) {
  const Vec3d q = snapped(p, step);
  return {q.x(), q.y(), q.z()};
}

// Moves the corners of triangles at fault to the nearest point of a grid, and with them all
// points that have the same nearest point.
std::size_t snap_concerned(TriangleSoup& mesh, const SelfIntersections& found, double step) {
  std::vector<GridCell> cells;
  const auto add = [&](std::uint32_t triangle) {
    for (const std::uint32_t p : mesh.triangles[triangle]) {
      cells.push_back(cell_of(mesh.points[p], step));
    }
  };
  for (const auto& pair : found.pairs) {
    add(pair[0]);
    add(pair[1]);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::size_t moved = 0;
  for (Vec3d& p : mesh.points) {
    const GridCell cell = cell_of(p, step);
    if (!std::binary_search(cells.begin(), cells.end(), cell)) continue;
    ++moved;
    p = {cell[0], cell[1], cell[2]};
  }
  return moved;
}

}  // namespace

Certification::Certification(Surface surface, const Grid& grid, const CertifyOptions& options,
                             ProgressObserver* progress, CertifyReport& report)
    : grid_(grid),
      options_(options),
      progress_(progress),
      report_(report),
      known_(kPairsToMend, &progress_) {
  report_ = {};
  spacing_ = number_spacing(surface.mesh, options.precision);
  step_ = options.precision == Precision::float32 ? std::max(grid.unit, spacing_) : grid.unit;
  round_step_ = step_;
  volume_ = signed_volume(surface.mesh);
  area_ = surface_area(surface.mesh);
  most_lost_ = kMostLost * std::abs(volume_) + kStepsMoved * spacing_ * area_;
  current_.surface = std::move(surface);
  test(current_);
  report_.pairs_at_first = current_.found.count;
  most_triangles_ = kMostGrowthOfPart * current_.surface.mesh.triangles.size();
  best_ = current_.faults() > 0 ? current_ : std::move(current_);
}

bool Certification::may_move_points() const {
  return options_.most_rounds > 0 && report_.pairs_at_first <= options_.most_pairs_at_first;
}

// Often all that is wrong is that input points are written with their own coordinates.
bool Certification::may_settle() const {
  return may_move_points() && best_.misplaced() > 0 && options_.precision == Precision::float64;
}

Surface Certification::settled(Surface surface) {
  settle_input_points(surface, grid_, known_);
  return surface;
}

void Certification::settle() {
  settle_input_points(current_.surface, grid_, known_);
  test(current_);
  keep_if_better(current_);
}

void Certification::start_again(Surface surface) {
  current_ = {};
  current_.surface = std::move(surface);
  test(current_);
  keep_if_better(current_);
}

void Certification::mend_in_place() {
  if (may_move_points()) {
    if (best_.misplaced() > 0) improve(current_);
  } else if (best_.joined > 0 && options_.most_rounds == 0) {
    separate(best_);
  }
  most_triangles_ = kMostGrowthOfPart * current_.surface.mesh.triangles.size();
}

std::vector<Surface> Certification::take_faulty_groups() {
  const SelfIntersections& found = best_.found;
  if (!may_move_points() || best_.misplaced() == 0 || found.pairs.size() < found.count) return {};
  const auto at_fault = triangles_at_fault(best_.surface.mesh, found, best_.joined > 0);
  const PartGroups groups = groups_apart(best_.surface.mesh);
  if (at_fault.empty() || groups.size() < 2) return {};
  current_ = {};
  progress_.begin_step();
  return take_groups(best_.surface, groups, at_fault);
}

void Certification::give_back(Certification& group) {
  report_.rounds = std::max(report_.rounds, group.report_.rounds);
  report_.snapped_points += group.report_.snapped_points;
  best_.dropped_parts += group.best_.dropped_parts;
  faults_of_groups_ += group.best_.misplaced();
  append_surface(best_.surface, group.best_.surface);
}

// Of the whole as it is now: groups may have moved to each other, and what is too thin goes.
void Certification::end_groups() {
  test(best_);
  if (best_.misplaced() <= faults_of_groups_) {  // groups have had all repairs that may be of use
    last_places_ = 0;
    snaps_ = kMostSnaps;
    vain_rounds_ = kMostVain;
    return;
  }
  current_ = best_;
  mend_in_place();
}

bool Certification::may_go_on() const {
  return may_move_points() && best_.misplaced() > 0 && report_.rounds < options_.most_rounds &&
         vain_rounds_ < kMostVain && current_.surface.mesh.triangles.size() <= most_triangles_;
}

// What is on a coarser grid may cross again where much was cut, and takes cells. In double
// precision points are on the grid already.
bool Certification::has_few_places() const {
  return may_move_points() && options_.precision == Precision::float32 && best_.misplaced() > 0 &&
         best_.misplaced() <= pairs_by_chance(best_.surface.mesh.triangles.size());
}

bool Certification::are_few_places() const {
  return has_few_places() && best_.faults() < last_places_ && places_repaired_ < kMostPlaces;
}

bool Certification::may_snap_places() const { return has_few_places() && snaps_ < kMostSnaps; }

const Surface& Certification::begin_places() {
  ++places_repaired_;
  last_places_ = best_.faults();
  return best_.surface;
}

Surface Certification::begin_snapped_places() {
  Surface snapped = best_.surface;
  snap_concerned(snapped.mesh, best_.found, std::ldexp(step_, 2 * static_cast<int>(snaps_++)));
  return snapped;
}

void Certification::end_places(Surface again) {
  name_sources(best_.surface, again);
  Attempt attempt;
  attempt.surface = std::move(again);
  attempt.dropped_parts = best_.dropped_parts;
  test(attempt);
  keep_if_better(attempt);
  improve(std::move(attempt));
}

const Surface& Certification::begin_round() {
  ++report_.rounds;
  faults_before_ = best_.faults();
  report_.snapped_points = snap_concerned(current_.surface.mesh, current_.found, round_step_);
  snap_cut_triangles();
  return current_.surface;
}

void Certification::end_round(Surface again) {
  name_sources(current_.surface, again);
  current_.surface = std::move(again);
  test(current_);
  keep_if_better(current_);
  if (current_.surface.mesh.triangles.size() > most_triangles_) return;
  improve(current_);
  vain_rounds_ = best_.faults() < faults_before_ ? 0 : vain_rounds_ + 1;
  round_step_ *= 4;
}

Surface Certification::result() {
  report_.pairs = best_.found.count;
  report_.degenerate = best_.found.degenerate;
  report_.joined_points = best_.joined;
  report_.inside_out_parts = best_.inside_out_parts;
  report_.dropped_parts = best_.dropped_parts;
  if (best_.dropped_parts > 0) {
    report_.dropped_share = std::max(0.0, 1 - surface_area(best_.surface.mesh) / area_);
  }
  report_.done = true;
  return std::move(best_.surface);
}

// `before`: where the points were before they were moved, if not just before rounding.
void Certification::test(Attempt& attempt, std::vector<Vec3d> before) {
  progress_.begin_step();
  if (before.empty()) before = attempt.surface.mesh.points;
  round_points(attempt.surface.mesh, options_.precision);
  attempt.dropped_parts += meshrepair::internal::drop_turned_parts(attempt.surface, before);
  join_ends(attempt.surface);
  attempt.found = known_.find(attempt.surface.mesh);
  if (const std::size_t dropped = drop_thin_at_fault(attempt); dropped > 0) {
    attempt.dropped_parts += dropped;
    attempt.found = known_.find(attempt.surface.mesh);
  }
  drop_inside_out(attempt);
  attempt.joined = options_.welded ? count_copies(attempt.surface.mesh) : 0;
}

void Certification::drop_inside_out(Attempt& attempt) {
  attempt.inside_out_parts = 0;
  if (attempt.found.count + attempt.found.degenerate > 0) return;
  const auto parts =
      meshrepair::internal::drop_inside_out_parts(attempt.surface, reach(), &progress_);
  attempt.inside_out_parts = parts.left;
  attempt.dropped_parts += parts.dropped;
}

// Those at fault whose walls are no further apart than what rounding moves them by.
std::size_t Certification::drop_thin_at_fault(Attempt& attempt) const {
  std::vector<std::uint32_t> at_fault;
  for (const auto& pair : attempt.found.pairs) {
    at_fault.insert(at_fault.end(), pair.begin(), pair.end());
  }
  if (at_fault.empty()) return 0;
  return meshrepair::internal::drop_thin_parts(attempt.surface, at_fault, 2 * spacing_);
}

// How far points may have been moved by now, with what nudge_points() and separate_copies() add.
double Certification::reach() const {
  return 256 * spacing_ + std::ldexp(step_, 2 * static_cast<int>(report_.rounds));
}

// What needs no new repair, as long as it is of much use.
void Certification::improve(Attempt moved) {
  const std::size_t triangles = moved.surface.mesh.triangles.size();
  if (moved.found.count > std::max(kManyFaults, triangles / kTrianglesOfFault)) return;
  do {
    bool is_of_use = true;
    while (is_of_use) {
      const std::size_t faults = moved.faults();
      if (faults > 0) move_points(moved);
      keep_if_better(moved);
      is_of_use = are_fewer(moved.faults(), faults);
    }
  } while (mend_places(moved));
}

void Certification::move_points(Attempt& attempt) {
  if (attempt.joined > 0) separate(attempt);
  if (attempt.found.count + attempt.found.degenerate == 0) return;
  nudge_points(attempt.surface, attempt.found, options_.precision, &progress_);
  test(attempt);
}

// What chance does not mend. Whether it is of use.
bool Certification::mend_places(Attempt& attempt) {
  if (attempt.found.count + attempt.found.degenerate == 0) return false;
  MendOptions options;
  options.step = spacing_;
  options.within = std::max(step_, kMendSteps * spacing_);
  options.rounded = [&](const Vec3d& p) { return rounded_to(p, options_.precision); };
  options.progress = &progress_;
  Attempt mended = attempt;
  if (mend_faults(mended.surface, mended.found, options) == 0) return false;
  test(mended);
  if (mended.faults() >= attempt.faults()) return false;
  attempt = std::move(mended);
  keep_if_better(attempt);
  return true;
}

void Certification::separate(Attempt& attempt) {
  Attempt apart = attempt;
  separate_copies(apart.surface.mesh, spacing_, options_.precision, options_.touching, &progress_);
  forget_moved_points(apart.surface, attempt.surface.mesh.points);
  test(apart, attempt.surface.mesh.points);
  if (apart.faults() < attempt.faults()) attempt = std::move(apart);
}

void Certification::keep_if_better(const Attempt& attempt) {
  if (attempt.faults() < best_.faults() && is_whole(attempt)) best_ = attempt;
}

// Also where volumes are beyond the range of doubles.
bool Certification::is_whole(const Attempt& attempt) const {
  return !(std::abs(signed_volume(attempt.surface.mesh) - volume_) > most_lost_);
}

// Points that are not of the input have to move onto the grid, and what they move is decided
// anew: there all corners have to be where the decisions are made.
void Certification::snap_cut_triangles() {
  TriangleSoup& mesh = current_.surface.mesh;
  const auto is_new = [&](std::uint32_t p) { return current_.surface.input_point[p] == 0; };
  std::vector<char> moves(mesh.points.size(), 0);
  for (const auto& t : mesh.triangles) {
    if (std::none_of(t.begin(), t.end(), is_new)) continue;
    for (const std::uint32_t p : t) moves[p] = 1;
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (moves[i] != 0) mesh.points[i] = snapped(mesh.points[i], step_);
  }
}

}  // namespace meshrepair::internal
