#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include <bsp/double_predicates.h>
#include <extract/part_orientation.h>
#include <extract/self_intersections.h>
#include <extract/simplify_cuts.h>

#include "collapsible_mesh.h"
#include "part_volumes.h"
#include "star_distance.h"

namespace meshrepair {
namespace {

using internal::CollapsibleMesh;
using internal::PointStar;
using internal::StarDistance;

constexpr std::uint32_t kNone = ~std::uint32_t{0};
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Moves are made in the order of their distances, but among those below this share of the bound,
// which make little difference, the shortest first: long ones leave long thin triangles.
constexpr double kSmallShare = 1.0 / 64;

// Parts that are not thicker than this times the bound stay: what is little for the surface is much
// for them.
constexpr double kThinParts = 20;

// The work for a star grows with the cube of its size, so larger ones are not looked at again after
// each move around them.
constexpr std::uint32_t kLargeStar = 10;

// Rounds in which as few points as may be are told to stay; and those after which all do.
constexpr std::size_t kPatientRounds = 2;
constexpr std::size_t kMostRounds = 16;

// More are found in the next round.
constexpr std::size_t kMostPairs = 200'000;

struct Move {
  double distance = kInfinite;  // of the new triangles from the surface at first
  double cost = 0, length = 0;
  std::uint32_t point = kNone, target = kNone;
  std::uint32_t version = 0;  // of the point's star

  // Of a queue whose top is the largest.
  bool operator<(const Move& other) const {
    return std::tie(cost, length, point) > std::tie(other.cost, other.length, other.point);
  }
};

// One run over all points that may go.
class CutSimplifier {
 public:
  CutSimplifier(const TriangleSoup& mesh, const std::vector<char>& stays, double within,
                ProgressObserver* progress)
      : points_(mesh.points),
        stays_(stays),
        within_(within),
        cancel_(progress),
        mesh_(mesh.triangles, mesh.points.size()),
        version_(mesh.points.size(), 0),
        waits_(mesh.points.size(), 0),
        distance_(mesh.triangles.size(), 0),
        moved_onto_(mesh.points.size(), kNone),
        last_moved_(mesh.triangles.size(), kNone) {}

  void run() {
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      if (stays_[p] == 0) consider(p);
    }
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

  [[nodiscard]] const CollapsibleMesh& mesh() const { return mesh_; }
  [[nodiscard]] bool has_moved(std::uint32_t point) const { return moved_onto_[point] != kNone; }
  // Where each point is now: where it was, if it has not moved.
  [[nodiscard]] std::vector<std::uint32_t> places() const {
    std::vector<std::uint32_t> places(moved_onto_.size());
    std::iota(places.begin(), places.end(), 0u);
    for (auto point = moves_.rbegin(); point != moves_.rend(); ++point) {
      places[*point] = places[moved_onto_[*point]];
    }
    return places;
  }
  // The point whose move changed the triangle last, or kNone.
  [[nodiscard]] std::uint32_t last_moved(std::uint32_t triangle) const {
    return last_moved_[triangle];
  }
  [[nodiscard]] double distance() const { return farthest_; }

 private:
  void consider(std::uint32_t point) {
    Move best;
    best.cost = best.length = kInfinite;
    best.point = point;
    best.version = version_[point];
    if (!mesh_.find_star(point, star_)) return;
    double before = 0;
    for (const std::uint32_t t : star_.triangles) before = std::max(before, distance_[t]);
    link_.clear();
    for (const std::uint32_t p : star_.link) link_.push_back(points_[p]);
    star_distance_.set_star(points_[point], link_);
    for (std::size_t i = 0; i < link_.size(); ++i) {
      Move move = best;
      move.target = star_.link[i];
      move.length = (link_[i] - points_[point]).stableNorm();
      move.distance = before + std::min(star_distance_.bound(i, within_ - before), move.length);
      if (!(move.distance <= within_)) continue;
      move.cost = std::max(move.distance, kSmallShare * within_);
      if (best < move && may_move(i)) best = move;
    }
    if (best.target != kNone) queue_.push(best);
  }

  // Until all moves that are known have been made.
  void postpone(std::uint32_t point) {
    if (waits_[point] != 0) return;
    waits_[point] = 1;
    Move later;
    later.cost = later.length = kInfinite;
    later.point = point;
    queue_.push(later);
  }

  bool may_move(std::size_t to) {
    if (!mesh_.may_collapse(star_, to)) return false;
    for (std::size_t i = star_.after(to); star_.after(i) != to; i = star_.after(i)) {
      if (projection_axis(link_[to], link_[i], link_[star_.after(i)]) < 0) return false;
    }
    return true;
  }

  void make(const Move& move) {
    if (!mesh_.find_star(move.point, star_)) return;
    const auto to = static_cast<std::size_t>(
        std::find(star_.link.begin(), star_.link.end(), move.target) - star_.link.begin());
    if (to == star_.link.size()) return;
    if (!mesh_.may_collapse(star_, to)) {
      // What the points have in common may have changed beyond the star.
      ++version_[move.point];
      return consider(move.point);
    }
    mesh_.collapse(star_, to);
    moved_onto_[move.point] = move.target;
    moves_.push_back(move.point);
    farthest_ = std::max(farthest_, move.distance);
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

  const std::vector<Vec3d>& points_;
  const std::vector<char>& stays_;
  double within_;
  CancelCheck cancel_;
  CollapsibleMesh mesh_;
  std::vector<std::uint32_t> version_;
  std::vector<char> waits_;                // of each point, whether it is postponed
  std::vector<double> distance_;           // of each triangle from the surface at first, at most
  std::vector<std::uint32_t> moved_onto_;  // of each point, the neighbour, or kNone
  std::vector<std::uint32_t> moves_;       // the points that moved, in their order
  std::vector<std::uint32_t> last_moved_;  // of each triangle, the point that changed it last
  double farthest_ = 0;
  std::priority_queue<Move> queue_;
  PointStar star_;
  std::vector<Vec3d> link_;
  std::vector<std::uint32_t> around_;
  StarDistance star_distance_;
};

void keep_points(const TriangleSoup& mesh, const std::vector<char>& of, std::vector<char>& stays) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (of[t] == 0) continue;
    for (const std::uint32_t p : mesh.triangles[t]) stays[p] = 1;
  }
}

// Where parts touch, they have points in the same place. To move one of those would leave gaps that
// no other program can tell from none.
void keep_contacts(const TriangleSoup& mesh, std::vector<char>& stays) {
  std::vector<std::pair<std::array<double, 3>, std::uint32_t>> places;
  places.reserve(mesh.points.size());
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3d& p = mesh.points[i];
    places.push_back({{p.x(), p.y(), p.z()}, i});
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i].first != places[i - 1].first) continue;
    stays[places[i].second] = stays[places[i - 1].second] = 1;
  }
}

// The surface without what has gone; for each triangle that is left, which it was.
std::vector<std::uint32_t> compact(const Surface& from, const CutSimplifier& simplifier,
                                   Surface& to) {
  to = {};
  std::vector<std::uint32_t> new_index(from.mesh.points.size(), kNone), kept;
  for (std::uint32_t p = 0; p < from.mesh.points.size(); ++p) {
    if (simplifier.has_moved(p)) continue;
    new_index[p] = static_cast<std::uint32_t>(to.mesh.points.size());
    to.mesh.points.push_back(from.mesh.points[p]);
    to.input_point.push_back(from.input_point[p]);
  }
  for (std::uint32_t t = 0; t < from.mesh.triangles.size(); ++t) {
    if (!simplifier.mesh().is_left(t)) continue;
    const auto& c = simplifier.mesh().triangles()[t];
    to.mesh.triangles.push_back({new_index[c[0]], new_index[c[1]], new_index[c[2]]});
    to.source.push_back(from.source[t]);
    kept.push_back(t);
  }
  return kept;
}

// Triangles of the result that are not as they were.
std::vector<std::uint32_t> changed_triangles(const CutSimplifier& simplifier,
                                             const std::vector<std::uint32_t>& kept) {
  std::vector<std::uint32_t> changed;
  for (std::uint32_t t = 0; t < kept.size(); ++t) {
    if (simplifier.last_moved(kept[t]) != kNone) changed.push_back(t);
  }
  return changed;
}

// The triangles of the result that moves have brought where they meet others.
std::vector<std::uint32_t> meeting_triangles(const TriangleSoup& mesh,
                                             const std::vector<std::uint32_t>& changed,
                                             ProgressObserver* progress) {
  SelfIntersectionOptions options;
  options.most_pairs = kMostPairs;
  options.progress = progress;
  std::vector<std::uint32_t> blamed;
  for (const auto& pair : self_intersections(mesh, changed, options).pairs) {
    blamed.insert(blamed.end(), pair.begin(), pair.end());
  }
  return blamed;
}

// A part that another part's surface was moved across faces the wrong way: the changed triangles
// around it.
std::vector<std::uint32_t> turning_triangles(const TriangleSoup& mesh,
                                             const std::vector<std::uint32_t>& changed,
                                             double within, ProgressObserver* progress) {
  const PartOrientation parts = examine_part_orientation(mesh, progress);
  std::vector<Eigen::AlignedBox3d> boxes(parts.inside_out.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.inside_out[parts.part_of[t]] == 0) continue;
    for (const std::uint32_t p : mesh.triangles[t]) {
      boxes[parts.part_of[t]].extend(mesh.points[p]);
    }
  }
  std::erase_if(boxes, [](const Eigen::AlignedBox3d& box) { return box.isEmpty(); });
  std::vector<std::uint32_t> blamed;
  for (const std::uint32_t t : boxes.empty() ? std::vector<std::uint32_t>() : changed) {
    Eigen::AlignedBox3d reach;
    for (const std::uint32_t p : mesh.triangles[t]) reach.extend(mesh.points[p]);
    reach.min().array() -= within;
    reach.max().array() += within;
    if (std::any_of(boxes.begin(), boxes.end(),
                    [&](const Eigen::AlignedBox3d& box) { return box.intersects(reach); })) {
      blamed.push_back(t);
    }
  }
  return blamed;
}

// Of each triangle to blame, the point that changed it last; where that takes too many rounds, all
// points that ended in its corners. At least one point more each time.
void take_back(const CutSimplifier& simplifier, const std::vector<std::uint32_t>& kept,
               const std::vector<std::uint32_t>& blamed, bool all, std::vector<char>& stays) {
  std::vector<char> is_corner(stays.size(), 0);
  for (const std::uint32_t t : blamed) {
    const std::uint32_t last = simplifier.last_moved(kept[t]);
    if (last == kNone) continue;
    stays[last] = 1;
    for (const std::uint32_t p : simplifier.mesh().triangles()[kept[t]]) is_corner[p] = 1;
  }
  if (!all) return;
  const std::vector<std::uint32_t> places = simplifier.places();
  for (std::uint32_t p = 0; p < stays.size(); ++p) {
    if (simplifier.has_moved(p) && is_corner[places[p]] != 0) stays[p] = 1;
  }
}

}  // namespace

void simplify_cuts(Surface& surface, const std::vector<char>& whole, const SimplifyOptions& options,
                   SimplifyReport& report) {
  report = {};
  std::vector<char> stays(surface.mesh.points.size(), 0);
  keep_points(surface.mesh, whole, stays);
  if (!(options.within > 0) || std::find(stays.begin(), stays.end(), 0) == stays.end()) return;
  const internal::PartVolumes volumes(surface.mesh);
  keep_points(surface.mesh, volumes.in_thin_parts(surface.mesh, kThinParts * options.within),
              stays);
  keep_contacts(surface.mesh, stays);
  const auto to_stay = std::count(stays.begin(), stays.end(), 1);
  while (report.rounds < kMostRounds) {
    ++report.rounds;
    CutSimplifier simplifier(surface.mesh, stays, options.within, options.progress);
    simplifier.run();
    Surface result;
    const std::vector<std::uint32_t> kept = compact(surface, simplifier, result);
    const std::vector<std::uint32_t> changed = changed_triangles(simplifier, kept);
    if (changed.empty()) return;
    auto blamed = meeting_triangles(result.mesh, changed, options.progress);
    const bool meet = !blamed.empty();
    if (!meet) blamed = volumes.altered(result.mesh, kept, changed);
    if (blamed.empty())
      blamed = turning_triangles(result.mesh, changed, options.within, options.progress);
    if (!blamed.empty()) {
      take_back(simplifier, kept, blamed, !meet || report.rounds > kPatientRounds, stays);
      continue;
    }
    report.removed_points = surface.mesh.points.size() - result.mesh.points.size();
    report.removed_triangles = surface.mesh.triangles.size() - result.mesh.triangles.size();
    report.distance = simplifier.distance();
    report.points_to_stay =
        static_cast<std::size_t>(std::count(stays.begin(), stays.end(), 1) - to_stay);
    surface = std::move(result);
    return;
  }
}

}  // namespace meshrepair
