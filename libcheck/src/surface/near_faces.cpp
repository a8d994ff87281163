// SPDX-License-Identifier: MIT
// Which triangles face each other across a small distance: gaps between bodies, and walls that are
// thin. A tree of boxes, compared with itself, gives the pairs. Of two that are nearly parallel the
// overlap is found in the plane of the larger one, by clipping the other against its three sides as
// Sutherland and Hodgman do (1974), and the distance is that at the corners of the overlap.
//
// Whether solid or space is in between follows from the bodies, connected through edges of two
// triangles, and from the sign of their volumes: two faces that turn their backs on each other and
// are of one body, of a void and a body around it, or of two voids, have solid in between.
//
// All numbers are rounded: what is found is a measure, and the caller decides by exact predicates
// what meets.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <base/parallel.h>
#include <base/shared_progress.h>
#include <check/box_tree.h>
#include <check/internal/node_pairs.h>
#include <check/internal/oriented_boxes.h>
#include <check/near_faces.h>
#include <mesh/edge_table.h>
#include <mesh/weld_points.h>

namespace meshrepair {
namespace {

// Of the angle between two faces: 25 degrees. Where they are much wider than they are apart, all
// that overlap are more nearly parallel.
constexpr double kParallel = 0.9;

// Of the largest coordinate: each one was rounded when it was made, and so are a normal, a
// difference and three products on the way to a height. What is nearer is not apart.
constexpr double kRounding = 0x1p-49;

// A few milliseconds of work.
constexpr std::size_t kLeavesPerQuestion = 4096;

using Corners = std::array<Vec3d, 3>;

// A corner of where two triangles overlap.
struct OverlapCorner {
  Vec3d at;
  double height = 0;  // of the second triangle over the plane of the first
};

struct Facing {
  std::uint32_t body = 0;
  Vec3d normal = Vec3d::Zero();  // of length 1; zero where there is none
  double longest = 0;            // edge
};

// Of triangles.
struct Summary {
  std::uint32_t body = 0;  // that of all, or kNone
  Box normals;
  double reach = 0;  // the largest distance that one looks for

  void add(const Summary& other) {
    if (other.body != body) body = kNone;
    normals.add(other.normals);
    reach = std::max(reach, other.reach);
  }
};

// Whether one of these may be nearly parallel to one of those, and turned the other way if they are
// of one body.
bool may_face(const Summary& a, const Summary& b) {
  double least = -kRounding, most = kRounding;  // of the cosine
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] =
        std::minmax({a.normals.low[k] * b.normals.low[k], a.normals.low[k] * b.normals.high[k],
                     a.normals.high[k] * b.normals.low[k], a.normals.high[k] * b.normals.high[k]});
    least += low;
    most += high;
  }
  const bool is_one_body = a.body != kNone && a.body == b.body;
  return least <= -kParallel || (most >= kParallel && !is_one_body);
}

class NearFacesFinder {
 public:
  NearFacesFinder(const TriangleSoup& soup, const NearFacesOptions& options)
      : soup_(soup), options_(options) {}

  NearFacesFound run() {
    place_triangles();
    find_bodies();
    const BoxTree tree(boxes_);
    summarize(tree);
    if (internal::boxes_tell_little(tree, boxes_, [](auto, auto) { return false; })) {
      oriented_.emplace(tree, corners_in_order(tree));
    }
    NearFacesFound found = compare_all(tree);
    const auto by_triangles = [](const NearFaces& x, const NearFaces& y) {
      return std::array{x.a, x.b} < std::array{y.a, y.b};
    };
    std::sort(found.gaps.begin(), found.gaps.end(), by_triangles);
    std::sort(found.walls.begin(), found.walls.end(), by_triangles);
    return found;
  }

 private:
  void place_triangles() {
    const std::vector<std::uint32_t> place = first_in_place(soup_.points);
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      const auto& c = soup_.triangles[t];
      const IndexTriangle corners = {place[c[0]], place[c[1]], place[c[2]]};
      const Vec3d &p = soup_.points[c[0]], &q = soup_.points[c[1]], &r = soup_.points[c[2]];
      const Vec3d area = (q - p).cross(r - p);
      if (!area.allFinite() || area.isZero(0)) continue;
      sound_.push_back(t);
      triangles_.push_back(corners);
      facing_.push_back(
          {0, area.normalized(), std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()})});
      Box& box = boxes_.emplace_back();
      for (const Vec3d* corner : {&p, &q, &r}) box.add(*corner);
    }
  }

  void find_bodies() {
    DisjointSets sets(triangles_.size());
    std::vector<char> is_open(triangles_.size(), 0);
    const EdgeTable edges(triangles_);
    edges.for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() == 2) sets.join(sides[0] / 3, sides[1] / 3);
      if (sides.size() != 2) is_open[sides[0] / 3] = 1;
    });
    std::vector<double> volume(triangles_.size(), 0);
    is_void_.assign(triangles_.size(), 0);
    body_box_.resize(triangles_.size());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const std::uint32_t body = facing_[i].body = sets.root(i);
      const Corners c = corners_of(i);
      const Vec3d from = soup_.points[triangles_[body][0]];
      volume[body] += (c[0] - from).dot((c[1] - from).cross(c[2] - from));
      if (is_open[i] != 0) is_open[body] = 1;
      body_box_[body].add(boxes_[i]);
    }
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      is_void_[i] = volume[i] < 0 && is_open[i] == 0 ? 1 : 0;
    }
  }

  [[nodiscard]] Corners corners_of(std::uint32_t i) const {
    const IndexTriangle& t = triangles_[i];
    return {soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]]};
  }

  // The largest coordinate.
  [[nodiscard]] double size_of(std::uint32_t i) const {
    double size = 0;
    for (const Vec3d& p : corners_of(i)) size = std::max(size, p.cwiseAbs().maxCoeff());
    return size;
  }

  [[nodiscard]] double largest_between(std::uint32_t i) const {
    return std::min(options_.largest_distance, options_.share * facing_[i].longest);
  }

  [[nodiscard]] bool share_a_corner(std::uint32_t i, std::uint32_t k) const {
    const auto &a = triangles_[i], &b = triangles_[k];
    return std::any_of(a.begin(), a.end(), [&](std::uint32_t p) {
      return std::find(b.begin(), b.end(), p) != b.end();
    });
  }

  void summarize(const BoxTree& tree) {
    const auto nodes = tree.nodes();
    summary_.resize(nodes.size());
    for (std::size_t n = nodes.size(); n-- > 0;) {  // children come behind their parent
      if (nodes[n].is_leaf()) {
        const auto items = tree.order().subspan(nodes[n].first, nodes[n].count);
        summary_[n].body = facing_[items[0]].body;
        for (const std::uint32_t i : items) {
          Summary item{facing_[i].body, {}, largest_between(i)};
          item.normals.add(facing_[i].normal);
          summary_[n].add(item);
        }
      } else {
        summary_[n] = summary_[n + 1];
        summary_[n].add(summary_[nodes[n].right]);
      }
    }
  }

  [[nodiscard]] std::vector<Vec3d> corners_in_order(const BoxTree& tree) const {
    std::vector<Vec3d> corners;
    corners.reserve(3 * triangles_.size());
    for (const std::uint32_t i : tree.order()) {
      for (const Vec3d& p : corners_of(i)) corners.push_back(p);
    }
    return corners;
  }

  [[nodiscard]] NearFacesFound compare_all(const BoxTree& tree) const {
    const auto may_be_near = [&](internal::NodePair pair) {
      if (pair.a == pair.b) return true;
      const Summary &a = summary_[pair.a], &b = summary_[pair.b];
      const double reach = std::min(a.reach, b.reach);
      Box around = tree.nodes()[pair.a].box;
      around.widen(reach);
      return around.meets(tree.nodes()[pair.b].box) && may_face(a, b) &&
             (!oriented_ || oriented_->are_within(reach, pair.a, pair.b));
    };
    const auto tasks = internal::upper_node_pairs(tree.nodes(), may_be_near);
    SharedProgress progress(options_.progress, tasks.size());
    return parallel_reduce(
        tasks.size(), 1,
        [&](std::size_t task, std::size_t) {
          NearFacesFound part;
          std::size_t steps = 0;
          internal::walk_node_pairs(tree.nodes(), tasks[task], may_be_near,
                                    [&](internal::NodePair leaves) {
                                      if (++steps % kLeavesPerQuestion == 0) progress.poll();
                                      compare_leaves(tree, leaves, part);
                                    });
          progress.done();
          return part;
        },
        [](NearFacesFound& all, const NearFacesFound& part) {
          all.gaps.insert(all.gaps.end(), part.gaps.begin(), part.gaps.end());
          all.walls.insert(all.walls.end(), part.walls.begin(), part.walls.end());
        });
  }

  void compare_leaves(const BoxTree& tree, internal::NodePair leaves, NearFacesFound& found) const {
    const BoxNode &a = tree.nodes()[leaves.a], &b = tree.nodes()[leaves.b];
    for (std::uint32_t p = a.first; p < a.first + a.count; ++p) {
      const std::uint32_t i = tree.order()[p];
      for (std::uint32_t q = leaves.a == leaves.b ? p + 1 : b.first; q < b.first + b.count; ++q) {
        const std::uint32_t k = tree.order()[q];
        Box around = boxes_[i];
        around.widen(std::min(largest_between(i), largest_between(k)));
        if (around.meets(boxes_[k])) compare(std::min(i, k), std::max(i, k), found);
      }
    }
  }

  void compare(std::uint32_t i, std::uint32_t k, NearFacesFound& found) const {
    const Facing &a = facing_[i], &b = facing_[k];
    const double cosine = a.normal.dot(b.normal);
    const bool is_one_body = a.body == b.body;
    if (std::abs(cosine) < kParallel || (is_one_body && cosine > 0)) return;
    if (is_one_body && share_a_corner(i, k)) return;
    measure(i, k, cosine, found);
  }

  // Behind both of their faces: of one body, of a void and the body around it, or of two voids.
  [[nodiscard]] bool have_solid_between(std::uint32_t a, std::uint32_t b) const {
    if (a == b || (is_void_[a] != 0 && is_void_[b] != 0)) return true;
    return (is_void_[a] != 0 && is_around(b, a)) || (is_void_[b] != 0 && is_around(a, b));
  }

  [[nodiscard]] bool is_around(std::uint32_t a, std::uint32_t b) const {
    const Box &outer = body_box_[a], &inner = body_box_[b];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(outer.low[k] < inner.low[k] && outer.high[k] > inner.high[k])) return false;
    }
    return true;
  }

  void measure(std::uint32_t i, std::uint32_t k, double cosine, NearFacesFound& found) const {
    const bool is_larger = facing_[i].longest >= facing_[k].longest;
    const std::uint32_t base = is_larger ? i : k, other = is_larger ? k : i;
    const double largest = std::min(largest_between(i), largest_between(k));
    const double rounding = kRounding * std::max(size_of(i), size_of(k));
    if (is_apart(base, other, largest + rounding)) return;
    const std::vector<OverlapCorner> overlap = overlap_of(base, other);
    if (overlap.size() < 3) return;
    double least = std::abs(overlap[0].height), most = 0, low = 0, high = 0, extent = 0;
    Vec3d area = Vec3d::Zero();
    for (std::size_t c = 0; c < overlap.size(); ++c) {
      const double height = overlap[c].height;
      least = std::min(least, std::abs(height));
      most = std::max(most, std::abs(height));
      low = std::min(low, height);
      high = std::max(high, height);
      const Vec3d along = overlap[c].at - overlap[0].at;
      extent = std::max(extent, along.norm());
      if (c > 1) area += (overlap[c - 1].at - overlap[0].at).cross(along);
    }
    if (low < 0 && high > 0) least = 0;
    const bool is_behind = cosine < 0 && std::abs(low) > high;
    const bool is_wall = is_behind && have_solid_between(facing_[i].body, facing_[k].body);
    double apart = is_wall ? least : most;
    if (apart <= rounding) apart = 0;
    if (apart > largest || 0.5 * area.norm() <= apart * extent) return;
    (is_wall ? found.walls : found.gaps)
        .push_back({std::min(sound_[i], sound_[k]), std::max(sound_[i], sound_[k]), apart});
  }

  // Farther above the first or below it than `largest` all over, or beside it?
  [[nodiscard]] bool is_apart(std::uint32_t base, std::uint32_t other, double largest) const {
    const Corners a = corners_of(base), b = corners_of(other);
    const Vec3d& normal = facing_[base].normal;
    const auto all = [&](const auto& is) { return is(b[0]) && is(b[1]) && is(b[2]); };
    if (all([&](const Vec3d& p) { return normal.dot(p - a[0]) > largest; })) return true;
    if (all([&](const Vec3d& p) { return normal.dot(p - a[0]) < -largest; })) return true;
    for (std::size_t side = 0; side < 3; ++side) {
      const Vec3d inward = normal.cross(a[(side + 1) % 3] - a[side]);
      if (all([&](const Vec3d& p) { return inward.dot(p - a[side]) < 0; })) return true;
    }
    return false;
  }

  // As seen along the normal of the first.
  [[nodiscard]] std::vector<OverlapCorner> overlap_of(std::uint32_t base,
                                                      std::uint32_t other) const {
    const Corners a = corners_of(base), b = corners_of(other);
    const Vec3d& normal = facing_[base].normal;
    std::vector<OverlapCorner> polygon, clipped;
    for (const Vec3d& p : b) {
      const double height = normal.dot(p - a[0]);
      polygon.push_back({p - height * normal, height});
    }
    for (std::size_t side = 0; side < 3; ++side) {
      const Vec3d inward = normal.cross(a[(side + 1) % 3] - a[side]);
      clipped.clear();
      for (std::size_t c = 0; c < polygon.size(); ++c) {
        const OverlapCorner &p = polygon[c], &q = polygon[(c + 1) % polygon.size()];
        const double at_p = inward.dot(p.at - a[side]), at_q = inward.dot(q.at - a[side]);
        if (at_p >= 0) clipped.push_back(p);
        if ((at_p < 0) == (at_q < 0)) continue;
        const double share = at_p / (at_p - at_q);
        clipped.push_back({p.at + share * (q.at - p.at), p.height + share * (q.height - p.height)});
      }
      polygon.swap(clipped);
    }
    return polygon;
  }

  const TriangleSoup& soup_;
  const NearFacesOptions& options_;
  std::vector<std::uint32_t> sound_;  // numbers in the soup of those that follow
  std::vector<IndexTriangle> triangles_;
  std::vector<Facing> facing_;
  std::vector<Box> boxes_;
  std::vector<char> is_void_;  // of each body
  std::vector<Box> body_box_;
  std::vector<Summary> summary_;                     // of each node of the tree
  std::optional<internal::OrientedBoxes> oriented_;  // none: boxes tell enough
};

}  // namespace

NearFacesFound find_near_faces(const TriangleSoup& soup, const NearFacesOptions& options) {
  return NearFacesFinder(soup, options).run();
}

}  // namespace meshrepair
