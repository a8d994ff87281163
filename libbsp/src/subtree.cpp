// SPDX-License-Identifier: MIT
// Building a part of the tree.
//
// Regions that have become much smaller than the one that was begun with are put off: each is then
// a part of its own, with a pool of its own, and several threads build them at once. What is put
// off depends on the numbers of fragments alone, and nothing that is chosen inside a region on what
// is outside of it. So the same tree comes out whatever the number of threads.
//
// Invariants:
// - Fragments of a region lie in its closure and have their interior in its interior: those in the
//   plane of an ancestor stayed there. So every plane chosen from a fragment cuts the region
//   properly, and so does a spatial cut with fragments strictly on both sides.
// - The fragments of one triangle inside one region are one convex polygon, so a triangle is named
//   at most once at a node.
// - An explicit stack replaces recursion: depth is not bounded by the machine's stack. Parts are
//   put off within parts, but each has at most an eighth of the fragments.
#include "subtree.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include <base/error.h>
#include <base/parallel.h>
#include <base/release.h>

#include "candidate_planes.h"
#include "spatial_cut.h"

namespace meshrepair::internal {
namespace {

// A region is put off that has at most one in so many of the fragments that its part began with ...
constexpr std::size_t kShareOfPart = 8;
// ... and at least these, some milliseconds of work.
constexpr std::size_t kLeastOfPart = 2048;

constexpr std::size_t kTicksPerProgress = 1024;

class SubtreeBuilder {
 public:
  SubtreeBuilder(const TreeTask& task, FragmentPool pool)
      : task_(task), options_(task.options), pool_(std::move(pool)), begun_with_(pool_.size()) {
    for (std::size_t i = 0; i < begun_with_; ++i) stack_.push_back(FragmentId(i));
  }

  Subtree run(const Region& region) {
    regions_.push_back(region);
    while (!regions_.empty()) {
      const Region next = regions_.back();
      regions_.pop_back();
      built_.report.depth = std::max(built_.report.depth, next.depth);
      if (stack_.size() == next.begin) {
        attach(next, TreeRef(built_.leaves.push_back({})));
      } else if (is_part(fragments(next).size())) {
        put_off(next);
      } else {
        divide(next);
      }
      if (++ticks_ % kTicksPerProgress == 0) tell_progress(stack_.size());
    }
    tell_progress(0);
    build_parts();
    count();
    return std::move(built_);
  }

  // The inside of the box, or what is left of it when the box is flat.
  Region divide_by(const std::vector<BoxPlane>& sides) {
    Region inside;
    for (const BoxPlane& side : sides) {
      distribute(inside, side.plane);
      add_node(inside, side.plane);
      // add_node() left both children; the outer one has no fragments.
      const Region front = regions_.back();
      const Region back = regions_[regions_.size() - 2];
      regions_.clear();
      inside = side.inside_is_front ? front : back;
      attach(side.inside_is_front ? back : front, TreeRef(built_.leaves.push_back({})));
    }
    return inside;
  }

 private:
  [[nodiscard]] bool is_part(std::size_t fragments) const {
    return fragments >= kLeastOfPart && fragments <= begun_with_ / kShareOfPart;
  }

  void put_off(const Region& region) {
    const auto list = fragments(region);
    PutOff part;
    part.region = region;
    part.fragments.assign(list.begin(), list.end());
    part.before = extent_of(built_);
    put_off_ += list.size();
    stack_.resize(region.begin);
    built_.put_off.push_back(std::move(part));
  }

  void build_parts() {
    release(stack_);
    parallel_for(built_.put_off.size(), [&](std::size_t i) {
      PutOff& part = built_.put_off[i];
      SubtreeBuilder builder(task_, FragmentPool(pool_, std::exchange(part.fragments, {})));
      Region region = part.region;
      region.parent = NodeId();
      region.begin = 0;
      part.subtree = builder.run(region);
    });
  }

  void count() {
    BuildTreeReport& all = built_.report;
    all.nodes = built_.nodes.size();
    all.leaves = built_.leaves.size();
    all.fragments = built_.node_triangles.size();
    for (const PutOff& part : built_.put_off) {
      const BuildTreeReport& more = part.subtree.report;
      all.nodes += more.nodes;
      all.leaves += more.leaves;
      all.depth = std::max(all.depth, more.depth);
      all.spatial_cuts += more.spatial_cuts;
      all.edge_cuts += more.edge_cuts;
      all.fragments += more.fragments;
      all.lost_fragments += more.lost_fragments;
    }
  }

  [[nodiscard]] std::span<const FragmentId> fragments(const Region& region) const {
    return {stack_.data() + region.begin, stack_.size() - region.begin};
  }

  void attach(const Region& region, TreeRef ref) {
    if (region.parent.valid()) {
      built_.nodes[region.parent].child[static_cast<std::size_t>(region.side)] = ref;
    } else {
      built_.root = ref;
    }
  }

  void divide(const Region& region) {
    const bool many = fragments(region).size() > options_.spatial_cut_above;
    if (many && divide_spatially(region)) return;
    const FragmentPlane chosen = choose_fragment_plane(pool_, fragments(region), options_);
    if (chosen.cost > judged(region) / (many ? 2 : 1) && divide_by_edge(region, chosen.cost))
      return;
    distribute(region, chosen.plane);
    add_node(region, pool_.soup_plane(chosen.plane));
  }

  bool divide_spatially(const Region& region) {
    const auto found = find_spatial_cut(pool_, fragments(region), options_);
    if (!found) return false;
    if (found->cut_share > options_.tolerated_cut_share) {
      const double cost = static_cast<double>(options_.split_weight * judged(region));
      if (divide_by_edge(region, static_cast<std::size_t>(cost * found->cut_share))) return true;
    }
    if (!divide_by_foreign_plane(region, found->plane)) return false;
    ++built_.report.spatial_cuts;
    return true;
  }

  bool divide_by_edge(const Region& region, std::size_t cost_to_beat) {
    const std::optional<Plane> cut =
        choose_edge_plane(pool_, task_.soup, fragments(region), options_, cost_to_beat);
    if (!cut || !divide_by_foreign_plane(region, *cut)) return false;
    ++built_.report.edge_cuts;
    return true;
  }

  // How many of a region's fragments a plane is judged on: the most that a plane may cost without
  // cutting any.
  [[nodiscard]] std::size_t judged(const Region& region) const {
    return std::min(options_.judged_fragments, fragments(region).size());
  }

  // By a plane that was not chosen as the plane of a fragment. It cuts the region if there are
  // fragments on both sides, or one in it; otherwise nothing is changed, and false returned.
  bool divide_by_foreign_plane(const Region& region, Plane cut) {
    make_canonical(cut);
    PlaneId plane = task_.soup.planes.find(cut);
    // Fragments may lie in it if it is of the soup, so it goes by the name that they have for it.
    PlaneId pool_plane = plane.valid() ? pool_.find(plane) : PlaneId();
    if (!pool_plane.valid()) pool_plane = pool_.add_plane(cut);
    if (!plane.valid()) {
      plane = PlaneId(task_.soup.planes.size() + built_.planes.size());
      built_.planes.push_back(cut);
    }
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
      if (!pieces.front.valid() && !pieces.back.valid()) ++built_.report.lost_fragments;
    }
    stack_.resize(region.begin);
  }

  void add_node(const Region& region, PlaneId plane) {
    TreeNode node;
    node.plane = plane;
    node.first_triangle = begin_of_list(built_.node_triangles.size(), on_plane_.size());
    node.triangle_count = static_cast<std::uint32_t>(on_plane_.size());
    built_.node_triangles.insert(built_.node_triangles.end(), on_plane_.begin(), on_plane_.end());
    const NodeId id = built_.nodes.push_back(node);
    attach(region, TreeRef(id));
    // The front is divided first, so it goes on top.
    const std::size_t back_begin = stack_.size();
    stack_.insert(stack_.end(), back_.begin(), back_.end());
    regions_.push_back({id, 1, back_begin, region.depth + 1});
    const std::size_t front_begin = stack_.size();
    stack_.insert(stack_.end(), front_.begin(), front_.end());
    regions_.push_back({id, 0, front_begin, region.depth + 1});
  }

  // Done is what has left the stack and was not put off; fragments born from cuts make it grow
  // again, hence the maximum.
  void tell_progress(std::size_t left) {
    const std::size_t done = begun_with_ - std::min(begun_with_, left + put_off_);
    task_.progress.add(done - std::min(done, told_));
    told_ = std::max(told_, done);
  }

  const TreeTask& task_;
  const BuildTreeOptions& options_;
  FragmentPool pool_;
  std::size_t begun_with_;
  std::size_t put_off_ = 0;
  Subtree built_;
  std::vector<FragmentId> stack_;
  std::vector<Region> regions_;
  std::vector<FragmentId> front_, back_;
  std::vector<TriangleId> on_plane_;
  std::size_t ticks_ = 0;
  std::size_t told_ = 0;
};

}  // namespace

void TreeProgress::add(std::size_t done) {
  if (observer_ == nullptr) return;
  const std::scoped_lock lock(mutex_);
  if (observer_->cancelled()) throw Cancelled();
  done_ += done;
  // Cuts may make more fragments than were counted.
  observer_->advance(std::min(1.0, static_cast<double>(done_) / static_cast<double>(fragments_)));
}

Subtree build_whole(const TreeTask& task, const std::vector<BoxPlane>& sides) {
  SubtreeBuilder builder(task, FragmentPool(task.soup));
  return builder.run(builder.divide_by(sides));
}

}  // namespace meshrepair::internal
