// SPDX-License-Identifier: MIT
// A queue has each edge, by what its collapse costs: the least value that the quadric of the planes
// around its two points takes where the volume stays. The cheapest is collapsed to that place, or
// to one of its ends, if the guard lets it. Edges of a point that has moved come into the queue
// again, and so do those that turn out to cost more than they did; what is in it of earlier states
// of a point is passed over. What was refused is tried again when nothing else is left, as its
// surroundings may have changed.
//
// All of this is done with the mesh scaled by a power of two to about unit size, which is exact.
// Points that have not moved keep their coordinates.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include <base/error.h>
#include <base/ids.h>
#include <mesh/internal/collapsible_mesh.h>
#include <mesh/mesh_parts.h>
#include <simplify/decimate.h>

#include "collapse_guard.h"
#include "corner_places.h"
#include "cost_queue.h"
#include "distance_guard.h"
#include "quadric.h"
#include "seam_edges.h"
#include "value_quadrics.h"

namespace meshrepair {
namespace {

using internal::Collapse;
using internal::CollapseGuard;
using internal::CollapsibleMesh;
using internal::CornerPlaces;
using internal::CostQueue;
using internal::DistanceGuard;
using internal::PointStar;
using internal::Quadric;
using internal::Refusal;
using internal::SeamEdges;
using internal::ValueQuadrics;

// Where the surface is flat, what collapses cost is rounding, and short edges go first: so much of
// the squared length is added.
constexpr double kShare = 1e-10;

// Seams hold more than the surface.
constexpr double kSeamWeight = 10;

// From the middle of an edge, in its lengths: what is farther away is beyond rounding.
constexpr double kFarthest = 2;

// Another round through what was refused pays if the last one took away more than one in so many of
// the triangles that are left.
constexpr std::size_t kFewOfLeft = 256;
constexpr std::size_t kFewWithin = 16;  // where there is a distance, as the tests are dear

// Where quadrics tell of an error so many times the distance that is allowed, no one has to look.
constexpr double kHopeless = 2;

// What a point may do.
enum class Freedom : std::uint8_t { free, on_seam, fixed };

using Stay = DecimationOptions::Stay;

class Decimator {
 public:
  Decimator(const TriangleSoup& mesh, const DecimationOptions& options, DecimationReport& report)
      : options_(options),
        report_(report),
        check_(options.progress),
        has_limit_(std::isfinite(options.distance)),
        scale_(mesh.points),
        given_(mesh.points),
        points_(scaled(mesh.points, scale_)),
        mesh_(mesh.triangles, mesh.points.size()),
        guard_(mesh_, points_, find_parts(mesh)),
        seams_(mesh_, options.seams),
        quadrics_(mesh.points.size()),
        freedom_(mesh.points.size(), Freedom::free),
        version_(mesh.points.size(), 0),
        became_(mesh.points.size(), kNone),
        first_(mesh.triangles.size()),
        left_(first_) {
    const bool has_guard = has_limit_ && options.judge == nullptr;
    if (options.find_corners || has_guard) places_.emplace(mesh.triangles, points_, options.seams);
    if (has_guard) distance_.emplace(points_, mesh.triangles, scale_(options.distance));
    fix_points();
    add_quadrics();
    if (options.values_of_corner > 0) add_values();
    if (!has_limit_) planes_now_ = quadrics_;
    has_changed_.assign(points_.size(), 0);
  }

  void run() {
    std::size_t gone = left_;  // in the last round
    const std::size_t few = has_limit_ ? kFewWithin : kFewOfLeft;
    while (left_ > options_.triangles && gone > left_ / few) {
      const std::size_t before = left_;
      report_.would_change_topology = report_.would_break_seam = report_.would_fold = 0;
      report_.would_meet = report_.would_part = 0;
      fill_queue();
      while (left_ > options_.triangles && !queue_.empty()) {
        const Edge edge = queue_.pop();
        check_.tick();
        if (edge.version != version_[edge.from] + version_[edge.to]) continue;
        if (became_[edge.from] != kNone || became_[edge.to] != kNone) continue;
        if (!costs_more_now(edge)) try_to_collapse(edge);
      }
      gone = before - left_;
    }
  }

  [[nodiscard]] DecimatedMesh result() const {
    DecimatedMesh result;
    std::vector<std::uint32_t> number(points_.size(), kNone);
    const auto& triangles = mesh_.triangles();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (!mesh_.is_left(t)) continue;
      std::array<std::uint32_t, 3> corners = triangles[t];
      for (std::uint32_t& p : corners) {
        if (number[p] == kNone) {
          number[p] = static_cast<std::uint32_t>(result.mesh.points.size());
          result.mesh.points.push_back(place_of(p));
        }
        p = number[p];
      }
      result.mesh.triangles.push_back(corners);
      result.source.push_back(t);
      if (!options_.find_corners) continue;
      for (std::uint32_t k = 0; k < 3; ++k) result.corners.push_back(corner_place(t, k));
    }
    std::vector<std::uint32_t> became = became_;
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      std::uint32_t end = p;
      while (became[end] != kNone) {  // half of the way goes for whoever comes here again
        if (became[became[end]] != kNone) became[end] = became[became[end]];
        end = became[end];
      }
      result.point.push_back(number[end]);
    }
    return result;
  }

 private:
  static std::vector<Vec3d> scaled(std::vector<Vec3d> points, const UnitScale& scale) {
    for (Vec3d& p : points) p = scale(p);
    return points;
  }

  [[nodiscard]] Vec3d place_of(std::uint32_t p) const {
    return points_[p] == scale_(given_[p]) ? given_[p] : scale_.back(points_[p]);
  }

  [[nodiscard]] CornerPlace corner_place(std::uint32_t t, std::uint32_t k) const {
    const Vec3d& p = points_[mesh_.triangles()[t][k]];
    const Vec3d nearest = places_->nearest(3 * t + k, p);
    return {places_->triangle(3 * t + k),
            nearest == p ? place_of(mesh_.triangles()[t][k]) : scale_.back(nearest)};
  }

  // Where both points go. The ends come into the queue with what they cost when the best place was
  // refused.
  enum class Way : std::uint8_t { best, to, from };

  struct Edge {
    double cost;
    std::uint32_t from, to;
    std::uint32_t version;  // of both ends, added: either only grows
    Way way;
  };

  void fix_points() {
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      if (is_held(p)) freedom_[p] = Freedom::fixed;
    }
    if (seams_.empty()) return;
    const std::vector<std::uint8_t> ends = seams_.count_ends(points_.size());
    for (std::size_t p = 0; p < points_.size(); ++p) {
      if (ends[p] == 0 || freedom_[p] == Freedom::fixed) continue;
      freedom_[p] = ends[p] == 2 ? Freedom::on_seam : Freedom::fixed;
    }
  }

  [[nodiscard]] Stay stays(std::uint32_t point) const {
    return options_.stays.empty() ? Stay::no : options_.stays[point];
  }

  [[nodiscard]] bool is_held(std::uint32_t point) const {
    return guard_.is_held(point) || stays(point) != Stay::no;
  }

  void add_quadrics() {
    const auto& triangles = mesh_.triangles();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& corners = triangles[t];
      const std::array<Vec3d, 3> at = {points_[corners[0]], points_[corners[1]],
                                       points_[corners[2]]};
      const Vec3d across = (at[1] - at[0]).cross(at[2] - at[0]);
      const double doubled_area = across.norm();
      if (!(doubled_area > 0)) continue;
      const Vec3d normal = across / doubled_area;
      for (const std::uint32_t p : corners) {
        quadrics_[p].add_plane(normal, at[0], doubled_area / 6);
      }
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (!seams_.is_seam(t, k)) continue;
        const Vec3d along = at[(k + 1) % 3] - at[k];
        const Vec3d wall = along.cross(normal).normalized();
        for (const std::uint32_t p : {corners[k], corners[(k + 1) % 3]}) {
          quadrics_[p].add_plane(wall, at[k], kSeamWeight * along.squaredNorm() / 4);
        }
      }
    }
  }

  // But of points of seams, where corners have others on the other side.
  void add_values() {
    const std::size_t each = 3 * options_.values_of_corner;
    values_.emplace(points_.size(), options_.values_of_corner);
    std::vector<double> values(each);
    for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) {
      const auto& corners = mesh_.triangles()[t];
      const std::array<Vec3d, 3> at = {points_[corners[0]], points_[corners[1]],
                                       points_[corners[2]]};
      for (std::size_t i = 0; i < each; ++i) values[i] = scale_(options_.values[each * t + i]);
      const double weight = (at[1] - at[0]).cross(at[2] - at[0]).norm() / 6;
      for (const std::uint32_t p : corners) {
        if (freedom_[p] == Freedom::free) values_->add_triangle(p, at, values, weight);
      }
    }
  }

  // Of the planes of the triangles around a point, as they are now: what earlier collapses moved
  // does not count again, which leaves the surface nearer in the mean (H. Hoppe, as in
  // value_quadrics.h).
  [[nodiscard]] const Quadric& planes_now(std::uint32_t p) {
    if (has_changed_[p] == 0) return planes_now_[p];
    Quadric planes;
    mesh_.visit_corners(p, [&](std::uint32_t, std::uint32_t next, std::uint32_t last) {
      const Vec3d across = (points_[next] - points_[p]).cross(points_[last] - points_[p]);
      const double doubled_area = across.norm();
      if (doubled_area > 0) planes.add_plane(across / doubled_area, points_[p], doubled_area / 6);
    });
    has_changed_[p] = 0;
    return planes_now_[p] = planes;
  }

  // With what their values cost. What is to stay near the first surface is held to its planes: a
  // seam, and all where there is a limit.
  [[nodiscard]] Quadric cost_of(std::uint32_t a, std::uint32_t b) {
    const bool is_free =
        !has_limit_ && freedom_[a] == Freedom::free && freedom_[b] == Freedom::free;
    Quadric both = is_free ? planes_now(a) : quadrics_[a];
    both.add(is_free ? planes_now(b) : quadrics_[b]);
    if (values_) values_->add_to(both, a, b);
    return both;
  }

  void fill_queue() {
    const auto& triangles = mesh_.triangles();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (!mesh_.is_left(t)) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
        if (a < b) queue_.push(edge_between(a, b));
      }
    }
  }

  // From the one that is to move, as far as it matters.
  [[nodiscard]] Edge edge_between(std::uint32_t a, std::uint32_t b) {
    if (freedom_[a] > freedom_[b] || (freedom_[a] == freedom_[b] && a < b)) std::swap(a, b);
    Edge edge{0, a, b, version_[a] + version_[b], Way::best};
    set_cost(edge);
    return edge;
  }

  // Triangles around it may have changed: then it comes into the queue again.
  [[nodiscard]] bool costs_more_now(Edge edge) {
    set_cost(edge);
    if (!queue_.has_cheaper(edge.cost)) return false;
    queue_.push(edge);
    return true;
  }

  void set_cost(Edge& edge) {
    const Quadric both = cost_of(edge.from, edge.to);
    edge.cost = both.at(place_for(edge, both, Quadric::Plane())) +
                kShare * both.weight() * (points_[edge.from] - points_[edge.to]).squaredNorm();
  }

  [[nodiscard]] Vec3d place_for(const Edge& edge, const Quadric& both,
                                const Quadric::Plane& on) const {
    if (edge.way == Way::best) return best_place(both, edge.from, edge.to, on);
    return points_[edge.way == Way::to ? edge.to : edge.from];
  }

  // The places at which the two points together enclose the volume that they enclose now (P.
  // Lindstrom and G. Turk: Fast and memory efficient polygonal simplification, 1998).
  [[nodiscard]] Quadric::Plane same_volume(std::uint32_t from, std::uint32_t to) {
    Quadric::Plane plane;
    const Vec3d at = points_[to];
    for (const std::uint32_t p : {from, to}) {
      mesh_.visit_corners(p, [&](std::uint32_t, std::uint32_t next, std::uint32_t last) {
        const Vec3d b = points_[next] - at, c = points_[last] - at;
        const Vec3d across = b.cross(c);
        if (p == from) plane.offset += (points_[from] - at).dot(across);
        if (p == from ? next != to && last != to : next != from && last != from) {
          plane.normal += across;
        }
      });
    }
    plane.offset += plane.normal.dot(at);
    return plane;
  }

  [[nodiscard]] Vec3d best_place(const Quadric& both, std::uint32_t from, std::uint32_t to,
                                 const Quadric::Plane& on) const {
    if (freedom_[to] == Freedom::fixed || freedom_[from] != freedom_[to]) return points_[to];
    const Vec3d &a = points_[from], &b = points_[to];
    Vec3d middle = 0.5 * (a + b);
    Vec3d place = both.least_near(middle, on);
    if ((place - middle).squaredNorm() <= kFarthest * kFarthest * (b - a).squaredNorm()) {
      return place;
    }
    const double at_a = both.at(a), at_b = both.at(b), at_middle = both.at(middle);
    if (at_middle <= at_a && at_middle <= at_b) return middle;
    return at_a < at_b ? a : b;
  }

  void try_to_collapse(const Edge& edge) {
    if (is_held(edge.from) || !find_collapse(edge)) {
      ++report_.would_change_topology;
      return;
    }
    if (stays(edge.to) == Stay::alone || (!seams_.empty() && !keeps_seams(edge))) {
      ++report_.would_break_seam;
      return;
    }
    const Quadric::Plane on =
        freedom_[edge.to] == Freedom::free ? same_volume(edge.from, edge.to) : Quadric::Plane();
    const Quadric cost = cost_of(edge.from, edge.to);
    const Vec3d place = place_for(edge, cost, on);
    collapse_.place = scale_(internal::rounded_to(scale_.back(place), options_.precision));
    const Refusal why = stays_near(edge, cost.at(place) / cost.weight()) ? guard_.refusal(collapse_)
                                                                         : Refusal::distance;
    if (why == Refusal::none) return make(edge);
    if (edge.way != Way::best) return;
    ++(why == Refusal::distance ? report_.would_part
       : why == Refusal::fold   ? report_.would_fold
                                : report_.would_meet);
    if (why == Refusal::distance || freedom_[edge.from] != freedom_[edge.to]) return;
    for (const Way way : {Way::to, Way::from}) {
      Edge other = edge;
      other.way = way;
      set_cost(other);
      queue_.push(other);
    }
  }

  // Values may be off by as much as places may: in the mean square, by their quadrics alone.
  [[nodiscard]] bool stays_near(const Edge& edge, double squared_error) {
    const double most = scale_(options_.distance);
    const double hopeless = values_ ? most : kHopeless * most;
    if (squared_error > hopeless * hopeless) return false;
    if (options_.judge != nullptr) return is_allowed(edge);
    if (!distance_) return true;
    if (!distance_->allows(collapse_, points_)) return false;
    list_corners([&](const auto& t) { return t.was_of_to ? edge.to : edge.from; });
    if (!places_->is_within(corners_, collapse_.place, most * most)) return false;
    return std::all_of(collapse_.fan.begin(), collapse_.fan.end(), [&](const auto& t) {
      const std::array<std::uint32_t, 2> nearby = {corner_of(t.triangle, t.next),
                                                   corner_of(t.triangle, t.last)};
      const Vec3d middle = 0.5 * (collapse_.place + points_[t.next]);
      const Vec3d centre = (collapse_.place + points_[t.next] + points_[t.last]) / 3;
      return places_->is_within(nearby, middle, most * most) &&
             places_->is_within(nearby, centre, most * most);
    });
  }

  [[nodiscard]] bool is_allowed(const Edge& edge) {
    question_.point = edge.to;
    question_.place = scale_.back(collapse_.place);
    question_.before.clear();
    question_.after.clear();
    for (const std::uint32_t t : collapse_.gone) question_.before.push_back(mesh_.triangles()[t]);
    for (const auto& t : collapse_.fan) {
      question_.before.push_back({t.was_of_to ? edge.to : edge.from, t.next, t.last});
      question_.after.push_back({edge.to, t.next, t.last});
    }
    return options_.judge->allows(question_);
  }

  [[nodiscard]] std::uint32_t corner_of(std::uint32_t triangle, std::uint32_t point) const {
    const auto& corners = mesh_.triangles()[triangle];
    const auto k = std::find(corners.begin(), corners.end(), point) - corners.begin();
    return 3 * triangle + static_cast<std::uint32_t>(k);
  }

  // Of the triangles of the fan, at their points.
  template <class PointOf>
  void list_corners(const PointOf& point_of) {
    corners_.clear();
    for (const auto& t : collapse_.fan) {
      corners_.push_back(corner_of(t.triangle, point_of(t)));
    }
  }

  // False where it may not be.
  bool find_collapse(const Edge& edge) {
    if (!mesh_.find_star(edge.to, star_of_to_) || !mesh_.find_star(edge.from, star_)) return false;
    const auto found = std::find(star_.link.begin(), star_.link.end(), edge.to);
    if (found == star_.link.end()) return false;
    const auto to = static_cast<std::size_t>(found - star_.link.begin());
    if (!mesh_.may_collapse(star_, to)) return false;
    at_ = to;
    collapse_.from = edge.from;
    collapse_.to = edge.to;
    collapse_.gone = {star_.triangles[to], star_.triangles[star_.before(to)]};
    const auto from = std::find(star_of_to_.link.begin(), star_of_to_.link.end(), edge.from);
    collapse_.fan.clear();
    append_to_fan(star_, to, false);
    append_to_fan(star_of_to_, static_cast<std::size_t>(from - star_of_to_.link.begin()), true);
    return true;
  }

  // All but the two at the other end of the edge: with both stars, once around the new point.
  void append_to_fan(const PointStar& star, std::size_t other_end, bool is_of_to) {
    for (std::size_t i = star.after(other_end); star.after(i) != other_end; i = star.after(i)) {
      collapse_.fan.push_back(
          {star.triangles[i], star.link[i], star.link[star.after(i)], is_of_to});
    }
  }

  // A point of a seam moves along it, and no two seams become one.
  [[nodiscard]] bool keeps_seams(const Edge& edge) const {
    const Freedom freedom = freedom_[edge.from];
    if (freedom == Freedom::fixed) return false;
    if (freedom == Freedom::on_seam &&
        !seams_.is_seam_between(star_.triangles[at_], edge.from, edge.to)) {
      return false;
    }
    return !seams_.would_join(star_, at_);
  }

  void make(const Edge& edge) {
    if (!seams_.empty()) seams_.collapse(star_, at_, collapse_);
    mesh_.collapse(star_, at_);
    points_[edge.to] = collapse_.place;
    guard_.note_made(collapse_);
    if (distance_) distance_->note_made(collapse_);
    if (options_.judge != nullptr) options_.judge->note_made(question_);
    if (places_) move_corners(edge.to);
    quadrics_[edge.to].add(quadrics_[edge.from]);
    has_changed_[edge.to] = 1;
    for (const auto& t : collapse_.fan) has_changed_[t.next] = 1;
    if (values_) values_->join(edge.to, edge.from);
    became_[edge.from] = edge.to;
    ++version_[edge.to];
    left_ -= 2;
    ++report_.collapses;
    tell_progress();
    mesh_.visit_corners(edge.to, [&](std::uint32_t, std::uint32_t next, std::uint32_t) {
      queue_.push(edge_between(edge.to, next));
    });
  }

  // Those between two seams together.
  void move_corners(std::uint32_t point) {
    const auto& fan = collapse_.fan;
    list_corners([&](const auto&) { return point; });
    const auto is_last = [&](std::size_t i) {
      return !seams_.empty() && seams_.is_seam_between(fan[i].triangle, point, fan[i].last);
    };
    std::size_t first = 0;
    while (first < fan.size() && !is_last(first)) ++first;
    if (first < fan.size()) {
      const auto middle = static_cast<std::ptrdiff_t>(first) + 1;
      std::rotate(corners_.begin(), corners_.begin() + middle, corners_.end());
    }
    for (std::size_t i = 0, begin = 0; i < fan.size(); ++i) {
      if (i + 1 < fan.size() && !is_last((first + 1 + i) % fan.size())) continue;
      places_->move(std::span(corners_).subspan(begin, i + 1 - begin), points_[point]);
      begin = i + 1;
    }
  }

  void tell_progress() {
    constexpr std::size_t kSeldom = 1024;
    if (options_.progress == nullptr || report_.collapses % kSeldom != 0) return;
    const auto done = static_cast<double>(first_ - left_);
    options_.progress->advance(
        std::min(1.0, done / static_cast<double>(first_ - options_.triangles)));
  }

  const DecimationOptions& options_;
  DecimationReport& report_;
  CancelCheck check_;
  const bool has_limit_;  // of the distance
  const UnitScale scale_;
  const std::vector<Vec3d>& given_;
  std::vector<Vec3d> points_;  // scaled
  CollapsibleMesh mesh_;
  CollapseGuard guard_;
  SeamEdges seams_;
  std::optional<CornerPlaces> places_;     // if they are wanted, or there is
  std::optional<DistanceGuard> distance_;  // a limit
  std::vector<Quadric> quadrics_;          // of the planes that each point has come to stand for
  std::vector<Quadric> planes_now_;        // of those around each point; empty: there is a limit
  std::vector<std::uint8_t> has_changed_;  // of each point, whether these are older than the mesh
  std::optional<ValueQuadrics> values_;    // if there are any
  std::vector<Freedom> freedom_;
  std::vector<std::uint32_t> version_;  // of each point: how often its quadric has changed
  std::vector<std::uint32_t> became_;   // of each point that went, the one that it is now
  const std::size_t first_;             // triangles
  std::size_t left_;
  CostQueue<Edge> queue_;
  PointStar star_, star_of_to_;
  std::size_t at_ = 0;  // in the link of star_, the other end of the edge
  Collapse collapse_;
  CollapseJudge::Question question_;  // about it
  std::vector<std::uint32_t> corners_;
};

}  // namespace

DecimatedMesh decimate(const TriangleSoup& mesh, const DecimationOptions& options,
                       DecimationReport& report) {
  report = {};
  Decimator decimator(mesh, options, report);
  decimator.run();
  return decimator.result();
}

}  // namespace meshrepair
