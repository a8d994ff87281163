// SPDX-License-Identifier: MIT
#include "cut_simplifier.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include <base/roots.h>
#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

// Moves are made in the order of their distances, but among those below this share of the bound,
// which make little difference, the shortest first: long ones leave long thin triangles.
constexpr double kSmallShare = 1.0 / 64;

// The work for a star grows with the cube of its size, so larger ones are not looked at again after
// each move around them.
constexpr std::uint32_t kLargeStar = 10;

// Of the bound: how high triangles should be that are not flatter than those before.
constexpr double kNeedle = 0x1p-10;

// Of a triangle, above its longest side; in any unit.
double height_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  Vec3d ab = b - a, ac = c - a;
  const double unit = std::max(ab.cwiseAbs().maxCoeff(), ac.cwiseAbs().maxCoeff());
  if (!(unit > 0)) return 0;
  ab /= unit;
  ac /= unit;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
  return unit * (ab.cross(ac).norm() / std::sqrt(longest));
}

}  // namespace

bool CutSimplifier::Move::operator<(const Move& other) const {
  return std::tie(cost, length, point) > std::tie(other.cost, other.length, other.point);
}

CutSimplifier::CutSimplifier(const TriangleSoup& mesh, const std::vector<char>& stays,
                             const std::vector<double>& within, const Carried& carried,
                             ProgressObserver* progress)
    : points_(mesh.points),
      stays_(stays),
      within_(within),
      carried_(carried),
      cancel_(progress),
      mesh_(mesh.triangles, mesh.points.size()),
      version_(mesh.points.size(), 0),
      waits_(mesh.points.size(), 0),
      distance_(mesh.triangles.size(), 0),
      moved_onto_(mesh.points.size(), kNone),
      last_moved_(mesh.triangles.size(), kNone),
      to_consider_(mesh.points.size()) {
  std::iota(to_consider_.begin(), to_consider_.end(), 0u);
}

void CutSimplifier::run() {
  for (const std::uint32_t p : to_consider_) {
    if (stays_[p] == 0 && !has_moved(p)) consider(p);
  }
  to_consider_.clear();
  while (!queue_.empty()) {
    const Move move = queue_.top();
    queue_.pop();
    cancel_.tick();
    if (has_moved(move.point)) continue;
    if (move.target == kNone) {
      waits_[move.point] = 0;
      consider(move.point);
    } else if (move.version == version_[move.point]) {
      make(move);
    }
  }
}

std::vector<std::uint32_t> CutSimplifier::places() const {
  std::vector<std::uint32_t> places(moved_onto_.size());
  std::iota(places.begin(), places.end(), 0u);
  for (auto made = made_.rbegin(); made != made_.rend(); ++made) {
    places[made->point] = places[moved_onto_[made->point]];
  }
  return places;
}

double CutSimplifier::distance() const {
  double farthest = 0;
  for (std::uint32_t t = 0; t < distance_.size(); ++t) {
    if (mesh_.is_left(t)) farthest = std::max(farthest, distance_[t]);
  }
  return farthest;
}

void CutSimplifier::consider(std::uint32_t point) {
  Move best;
  best.point = point;
  best.version = version_[point];
  if (!mesh_.find_star(point, star_)) return;
  find_borders();
  const double within = std::min(within_[point], reach_of_star());
  double before = 0;
  for (const std::uint32_t t : star_.triangles) before = std::max(before, distance_[t]);
  link_.clear();
  for (const std::uint32_t p : star_.link) link_.push_back(points_[p]);
  star_distance_.set_star(points_[point], link_);
  double least_height = -1;
  for (std::size_t i = 0; i < link_.size(); ++i) {
    Move move = best;
    move.target = star_.link[i];
    move.length = stable_length(link_[i] - points_[point]);
    const double distance = std::min(star_distance_.bound(i, within - before), move.length);
    move.distance = before + std::max(distance, border_shift(i));
    if (!(move.distance <= within)) continue;
    move.cost = std::max(move.distance, kSmallShare * within);
    if (!(best < move)) continue;
    if (least_height < 0) least_height = height_to_keep(within);
    if (may_move(i, least_height)) best = move;
  }
  if (best.target != kNone) queue_.push(best);
}

void CutSimplifier::find_borders() {
  borders_.clear();
  if (carried_.reach.empty()) return;
  const auto source_at = [&](std::size_t i) { return carried_.source[star_.triangles[i]]; };
  for (std::size_t i = 0; i < star_.triangles.size(); ++i) {
    if (source_at(star_.before(i)) != source_at(i)) borders_.push_back(i);
  }
}

double CutSimplifier::reach_of_star() const {
  double reach = kInfinite;
  for (const std::size_t i : borders_) {
    const std::uint32_t source = carried_.source[star_.triangles[i]];
    if (source != kNone) reach = std::min(reach, carried_.reach[source]);
  }
  return reach;
}

// How far a move brings the line where two sources meet from where it was, or the point where
// more do.
double CutSimplifier::border_shift(std::size_t to) const {
  if (borders_.empty()) return 0;
  const Vec3d& point = points_[star_.point];
  if (borders_.size() > 2 || (to != borders_[0] && to != borders_[1])) {
    return stable_length(link_[to] - point);
  }
  const Vec3d from_start = point - link_[borders_[0]];
  const Vec3d line = link_[borders_[1]] - link_[borders_[0]];
  const double length = stable_length(line);
  if (!(length > 0)) return stable_length(from_start);
  const double along = std::clamp(from_start.dot(line / length), 0.0, length);
  return stable_length(from_start - along * (line / length));
}

void CutSimplifier::postpone(std::uint32_t point) {
  if (waits_[point] != 0) return;
  waits_[point] = 1;
  Move later;
  later.point = point;
  queue_.push(later);
}

bool CutSimplifier::may_move(std::size_t to, double least_height) {
  if (!mesh_.may_collapse(star_, to)) return false;
  for (std::size_t i = star_.after(to); star_.after(i) != to; i = star_.after(i)) {
    const Vec3d& a = link_[to];
    const Vec3d& b = link_[i];
    const Vec3d& c = link_[star_.after(i)];
    if (height_of(a, b, c) < least_height || projection_axis(a, b, c) < 0) return false;
  }
  return true;
}

// A triangle that is flatter than the bound, and than all that were there, is a needle that
// rounding may turn.
double CutSimplifier::height_to_keep(double within) const {
  double least = kNeedle * within;
  for (std::size_t i = 0; i < link_.size() && least > 0; ++i) {
    least = std::min(least, height_of(points_[star_.point], link_[i], link_[star_.after(i)]));
  }
  return least;
}

void CutSimplifier::make(const Move& move) {
  if (!mesh_.find_star(move.point, star_)) return;
  const auto to = static_cast<std::size_t>(
      std::find(star_.link.begin(), star_.link.end(), move.target) - star_.link.begin());
  if (to == star_.link.size()) return;
  if (!mesh_.may_collapse(star_, to)) {
    // What the points have in common may have changed beyond the star.
    ++version_[move.point];
    return consider(move.point);
  }
  remember(move, to);
  mesh_.collapse(star_, to);
  moved_onto_[move.point] = move.target;
  for (const std::uint32_t t : star_.triangles) {
    distance_[t] = move.distance;
    last_moved_[t] = move.point;
  }
  around_ = star_.link;
  for (const std::uint32_t p : around_) ++version_[p];
  for (const std::uint32_t p : around_) {
    if (stays_[p] != 0) continue;
    if (mesh_.degree(p) > kLargeStar) {
      postpone(p);
    } else {
      consider(p);
    }
  }
}

// It builds on what changed any triangle that was looked at to allow it: those of the point, the
// target, and the two that lose a triangle.
void CutSimplifier::remember(const Move& move, std::size_t to) {
  made_.push_back({move.point, changes_.size(), bases_.size()});
  for (const std::uint32_t t : star_.triangles) {
    changes_.push_back({distance_[t], last_moved_[t], t});
    if (last_moved_[t] != kNone) bases_.push_back(last_moved_[t]);
  }
  for (const std::size_t i : {star_.before(to), to, star_.after(to)}) {
    mesh_.visit_corners(star_.link[i], [&](std::uint32_t t, std::uint32_t, std::uint32_t) {
      if (last_moved_[t] != kNone) bases_.push_back(last_moved_[t]);
    });
  }
  const auto first = bases_.begin() + static_cast<std::ptrdiff_t>(made_.back().first_base);
  std::sort(first, bases_.end());
  bases_.erase(std::unique(first, bases_.end()), bases_.end());
}

void CutSimplifier::take_back() {
  const std::vector<char> is_taken_back = find_moves_to_take_back();
  std::size_t end_of_changes = changes_.size();
  for (auto made = made_.rbegin(); made != made_.rend(); ++made) {
    if (is_taken_back[made->point] != 0) take_back(*made, end_of_changes);
    end_of_changes = made->first_change;
  }
  forget_taken_back(is_taken_back);
  std::sort(to_consider_.begin(), to_consider_.end());
  to_consider_.erase(std::unique(to_consider_.begin(), to_consider_.end()), to_consider_.end());
}

// Of each point.
std::vector<char> CutSimplifier::find_moves_to_take_back() const {
  std::vector<char> taken_back(points_.size(), 0);
  for (std::size_t m = 0; m < made_.size(); ++m) {
    const std::size_t end = m + 1 < made_.size() ? made_[m + 1].first_base : bases_.size();
    bool goes = stays_[made_[m].point] != 0;
    for (std::size_t i = made_[m].first_base; i < end; ++i) goes |= taken_back[bases_[i]] != 0;
    taken_back[made_[m].point] = goes ? 1 : 0;
  }
  return taken_back;
}

void CutSimplifier::take_back(const Made& made, std::size_t end_of_changes) {
  around_.clear();
  for (std::size_t i = made.first_change; i < end_of_changes; ++i) {
    const Change& change = changes_[i];
    distance_[change.triangle] = change.distance;
    last_moved_[change.triangle] = change.last_moved;
    around_.push_back(change.triangle);
  }
  mesh_.restore(made.point, moved_onto_[made.point], around_);
  moved_onto_[made.point] = kNone;
  for (const std::uint32_t t : around_) {
    for (const std::uint32_t p : mesh_.triangles()[t]) look_again(p);
  }
}

void CutSimplifier::look_again(std::uint32_t point) {
  ++version_[point];
  to_consider_.push_back(point);
}

void CutSimplifier::forget_taken_back(const std::vector<char>& is_taken_back) {
  std::vector<Made> made;
  std::vector<Change> changes;
  std::vector<std::uint32_t> bases;
  for (std::size_t m = 0; m < made_.size(); ++m) {
    if (is_taken_back[made_[m].point] != 0) continue;
    const bool is_last = m + 1 == made_.size();
    const std::size_t end_of_changes = is_last ? changes_.size() : made_[m + 1].first_change;
    const std::size_t end_of_bases = is_last ? bases_.size() : made_[m + 1].first_base;
    made.push_back({made_[m].point, changes.size(), bases.size()});
    for (std::size_t i = made_[m].first_change; i < end_of_changes; ++i) {
      changes.push_back(changes_[i]);
    }
    for (std::size_t i = made_[m].first_base; i < end_of_bases; ++i) bases.push_back(bases_[i]);
  }
  made_ = std::move(made);
  changes_ = std::move(changes);
  bases_ = std::move(bases);
}

}  // namespace meshrepair::internal
