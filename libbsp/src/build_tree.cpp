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

#include <bsp/build_tree.h>
#include <bsp/error.h>

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
    regions_.push_back(inside);
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
    if (fragments(region).size() > options_.spatial_cut_above && divide_spatially(region)) return;
    const PlaneId plane = internal::choose_fragment_plane(pool_, fragments(region), options_);
    distribute(region, plane);
    add_node(region, plane);
  }

  bool divide_spatially(const Region& region) {
    const std::optional<Plane> cut = find_spatial_cut(pool_, fragments(region), options_);
    if (!cut) return false;
    distribute(region, pool_.add_plane(*cut));
    add_node(region, tree_.input.planes.intern(*cut).id);
    ++report_.spatial_cuts;
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
    regions_.push_back({id, 1, back_begin, region.depth + 1});
    const std::size_t front_begin = stack_.size();
    stack_.insert(stack_.end(), front_.begin(), front_.end());
    regions_.push_back({id, 0, front_begin, region.depth + 1});
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
