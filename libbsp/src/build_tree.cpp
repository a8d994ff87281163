// Building the tree.
//
// Idea: the first nodes are the planes of the input's bounding box, so that what lies beside it is
// cut off, and an opening that is flush with the box (a cup, half a body) has a plane that can
// close it. Then a region with many fragments is cut across an axis where that separates them; a
// small one is cut by the plane of one of its fragments, and all fragments in that plane stay at
// the node. What is left goes, cut where necessary, to the two sides. A region without fragments is
// a leaf.
//
// Invariants:
// - Fragments of a region lie in its closure and have their interior in its interior: those in the
// plane of
//   an ancestor stayed there. So every plane chosen from a fragment cuts the region properly, and
//   so does a spatial cut with fragments strictly on both sides.
// - The fragments of one triangle inside one region are one convex polygon, so a triangle is named
// at most
//   once at a node.
// - An explicit stack replaces recursion: depth is not bounded by the machine's stack.
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <base/error.h>
#include <bsp/build_tree.h>

#include "candidate_planes.h"
#include "fragment_pool.h"
#include "spatial_cut.h"

namespace meshrepair {
namespace {

using internal::find_spatial_cut;
using internal::Fragment;
using internal::FragmentId;
using internal::FragmentPool;

// A region whose fragments are the topmost part, from `begin` on, of the stack of fragment ids.
struct Region {
  NodeId parent;  // invalid for the root
  int side = 0;
  std::size_t begin = 0;
  std::size_t depth = 0;
  Vec3d low = Vec3d::Zero(), high = Vec3d::Zero();  // a box around it
};

struct BoxPlane {
  PlaneId plane;
  bool inside_is_front = false;
};

// The sides of the bounding box; one for each axis on which it is flat.
std::vector<BoxPlane> planes_of_bounding_box(CleanSoup& soup) {
  std::vector<BoxPlane> sides;
  if (soup.triangles.empty()) return sides;
  const GridBox box = bounding_box(soup);
  const std::array<std::int32_t, 3> low = {box.low.x, box.low.y, box.low.z};
  const std::array<std::int32_t, 3> high = {box.high.x, box.high.y, box.high.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<std::int64_t, 3> normal{};
    normal[axis] = 1;
    sides.push_back({soup.planes.intern(make_plane(normal, -Int128{low[axis]})).id, true});
    if (low[axis] == high[axis]) continue;
    sides.push_back({soup.planes.intern(make_plane(normal, -Int128{high[axis]})).id, false});
  }
  return sides;
}

class TreeBuilder {
 public:
  TreeBuilder(CleanSoup soup, const BuildTreeOptions& options, BuildTreeReport& report)
      : options_(options),
        report_(report),
        tree_{std::move(soup), {}, {}, {}, {}},
        box_planes_(planes_of_bounding_box(tree_.input)),
        pool_(tree_.input) {}

  Tree run() {
    for (std::size_t i = 0; i < pool_.size(); ++i) stack_.push_back(FragmentId(i));
    total_ = std::max<std::size_t>(stack_.size(), 1);
    divide_by_bounding_box();
    while (!regions_.empty()) {
      const Region region = regions_.back();
      regions_.pop_back();
      report_.depth = std::max(report_.depth, region.depth);
      if (stack_.size() == region.begin) {
        attach(region, TreeRef(tree_.leaves.push_back({})));
      } else if (options_.divides && !options_.divides(region.low, region.high)) {
        leave_undivided(region);
      } else {
        divide(region);
      }
      tell_progress();
    }
    report_.nodes = tree_.nodes.size();
    report_.leaves = tree_.leaves.size();
    report_.fragments = tree_.node_triangles.size();
    tree_.input.planes.release_index();
    return std::move(tree_);
  }

 private:
  // Leaves one region on the stack, the inside of the box, or what is left of it when the box is
  // flat.
  void divide_by_bounding_box() {
    Region inside;
    for (const BoxPlane& box_plane : box_planes_) {
      distribute(inside, box_plane.plane);
      add_node(inside, box_plane.plane);
      // add_node() left both children; the outer one has no fragments.
      const Region front = regions_.back();
      const Region back = regions_[regions_.size() - 2];
      regions_.clear();
      inside = box_plane.inside_is_front ? front : back;
      attach(box_plane.inside_is_front ? back : front, TreeRef(tree_.leaves.push_back({})));
    }
    const GridBox box = bounding_box(tree_.input);
    inside.low = as_vector(box.low);
    inside.high = as_vector(box.high);
    regions_.push_back(inside);
  }

  void leave_undivided(const Region& region) {
    for (const FragmentId id : fragments(region)) pool_.release(id);
    stack_.resize(region.begin);
    Leaf leaf;
    leaf.undivided = true;
    attach(region, TreeRef(tree_.leaves.push_back(leaf)));
  }

  std::span<const FragmentId> fragments(const Region& region) const {
    return {stack_.data() + region.begin, stack_.size() - region.begin};
  }

  void attach(const Region& region, TreeRef ref) {
    if (region.parent.valid()) {
      tree_.nodes[region.parent].child[static_cast<std::size_t>(region.side)] = ref;
    } else {
      tree_.root = ref;
    }
  }

  void divide(const Region& region) {
    const bool many = fragments(region).size() > options_.spatial_cut_above;
    if (many && divide_spatially(region)) return;
    const internal::FragmentPlane chosen =
        internal::choose_fragment_plane(pool_, fragments(region), options_);
    if (chosen.cost > judged(region) / (many ? 2 : 1) && divide_by_edge(region, chosen.cost))
      return;
    distribute(region, chosen.plane);
    add_node(region, chosen.plane);
  }

  bool divide_spatially(const Region& region) {
    const auto found = find_spatial_cut(pool_, fragments(region), options_);
    if (!found) return false;
    if (found->cut_share > options_.tolerated_cut_share) {
      const double cost = static_cast<double>(options_.split_weight * judged(region));
      if (divide_by_edge(region, static_cast<std::size_t>(cost * found->cut_share))) return true;
    }
    if (!divide_by_foreign_plane(region, found->plane)) return false;
    ++report_.spatial_cuts;
    return true;
  }

  bool divide_by_edge(const Region& region, std::size_t cost_to_beat) {
    const std::optional<Plane> cut =
        internal::choose_edge_plane(pool_, tree_.input, fragments(region), options_, cost_to_beat);
    if (!cut || !divide_by_foreign_plane(region, *cut)) return false;
    ++report_.edge_cuts;
    return true;
  }

  // How many of a region's fragments a plane is judged on: the most that a plane may cost without
  // cutting any.
  [[nodiscard]] std::size_t judged(const Region& region) const {
    return std::min(options_.judged_fragments, fragments(region).size());
  }

  // By a plane that was not chosen as the plane of a fragment. It cuts the region if there are
  // fragments on both sides, or one in it; otherwise nothing is changed, and false returned.
  bool divide_by_foreign_plane(const Region& region, const Plane& cut) {
    const PlaneId plane = tree_.input.planes.intern(cut).id;
    // The pool knows the planes that the soup had at the start; later ones have ids of its own
    // there.
    const PlaneId pool_plane =
        plane.index() < pool_.soup_planes() ? plane : pool_.add_plane(tree_.input.planes[plane]);
    distribute(region, pool_plane);
    if (on_plane_.empty() && (front_.empty() || back_.empty())) {
      stack_.insert(stack_.end(), front_.begin(), front_.end());
      stack_.insert(stack_.end(), back_.begin(), back_.end());
      return false;
    }
    add_node(region, plane);
    return true;
  }

  // Takes the region's fragments off the stack, sorted into front_, back_ and on_plane_.
  void distribute(const Region& region, PlaneId plane) {
    front_.clear();
    back_.clear();
    on_plane_.clear();
    for (const FragmentId id : fragments(region)) {
      if (pool_[id].plane == plane) {
        on_plane_.push_back(pool_[id].triangle);
        pool_.release(id);
        continue;
      }
      const auto pieces = pool_.split(id, plane);
      if (pieces.front.valid()) front_.push_back(pieces.front);
      if (pieces.back.valid()) back_.push_back(pieces.back);
      if (!pieces.front.valid() && !pieces.back.valid()) ++report_.lost_fragments;
    }
    stack_.resize(region.begin);
  }

  void add_node(const Region& region, PlaneId plane) {
    TreeNode node;
    node.plane = plane;
    node.first_triangle = static_cast<std::uint32_t>(tree_.node_triangles.size());
    node.triangle_count = static_cast<std::uint32_t>(on_plane_.size());
    tree_.node_triangles.insert(tree_.node_triangles.end(), on_plane_.begin(), on_plane_.end());
    const NodeId id = tree_.nodes.push_back(node);
    attach(region, TreeRef(id));
    // The front is divided first, so it goes on top.
    const std::size_t back_begin = stack_.size();
    stack_.insert(stack_.end(), back_.begin(), back_.end());
    regions_.push_back(part_of(region, 1, id, back_begin));
    const std::size_t front_begin = stack_.size();
    stack_.insert(stack_.end(), front_.begin(), front_.end());
    regions_.push_back(part_of(region, 0, id, front_begin));
  }

  // The part of a region on one side of a node. A plane across an axis makes its box smaller.
  [[nodiscard]] Region part_of(const Region& region, int side, NodeId node,
                               std::size_t begin) const {
    Region part{node, side, begin, region.depth + 1, region.low, region.high};
    const Plane& plane = tree_.input.planes[tree_.nodes[node].plane];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t n = plane.normal[axis];
      if (n == 0 || plane.normal[(axis + 1) % 3] != 0 || plane.normal[(axis + 2) % 3] != 0)
        continue;
      const double at = -static_cast<double>(plane.offset) / static_cast<double>(n);
      const bool is_above = (side == 0) == (n > 0);
      double& bound = is_above ? part.low[static_cast<Eigen::Index>(axis)]
                               : part.high[static_cast<Eigen::Index>(axis)];
      bound = is_above ? std::max(bound, at) : std::min(bound, at);
    }
    return part;
  }

  // Done is what has left the stack; fragments born from cuts make it grow again, hence the
  // maximum.
  void tell_progress() {
    if (options_.progress == nullptr || ++ticks_ % 1024 != 0) return;
    if (options_.progress->cancelled()) throw Cancelled();
    const double left = static_cast<double>(stack_.size()) / static_cast<double>(total_);
    share_ = std::max(share_, 1 - left);
    options_.progress->advance(share_);
  }

  BuildTreeOptions options_;
  BuildTreeReport& report_;
  Tree tree_;
  std::vector<BoxPlane> box_planes_;  // interned before the pool copies the planes
  FragmentPool pool_;
  std::vector<FragmentId> stack_;
  std::vector<Region> regions_;
  std::vector<FragmentId> front_, back_;
  std::vector<TriangleId> on_plane_;
  std::size_t total_ = 1;
  std::size_t ticks_ = 0;
  double share_ = 0;
};

}  // namespace

Tree build_tree(CleanSoup soup, const BuildTreeOptions& options, BuildTreeReport& report) {
  report = {};
  return TreeBuilder(std::move(soup), options, report).run();
}

}  // namespace meshrepair
