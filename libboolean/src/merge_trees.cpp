// SPDX-License-Identifier: MIT
// Insertion of one tree into another.
//
// Idea: walk down the first tree with the triangles of the second, parting them at each plane, as a
// tree is built. Where a leaf of the first does not decide the result, go on with the nodes of the
// second: a plane that leaves the region on one side is no node here, and only that child is looked
// at. Triangles lie at the node whose plane is theirs, whichever tree it comes from: so a facet
// that both solids have is covered by the triangles of both.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <base/error.h>
#include <boolean/merge_trees.h>

#include "collapse_tree.h"
#include "join_soups.h"
#include "region_tracker.h"

namespace meshrepair {
namespace {

using internal::Sides;

constexpr std::size_t kStepsPerQuestion = 1024;

void require_labels(const Tree& tree) {
  for (const Leaf& leaf : tree.leaves) {
    if (leaf.label == Label::unknown) throw InputError("the tree is not labelled");
  }
}

template <class Regions>
class Merger {
 public:
  Merger(const Tree& first, const Tree& second, SetOperation operation, const MergeOptions& options,
         MergeReport& report)
      : first_(first), second_(second), operation_(operation), options_(options), report_(report) {
    merged_.input = internal::join_soups(first.input, second.input, options.second_source, map_);
  }

  Tree run() {
    Regions regions(merged_.input);
    regions_ = &regions;
    Step all{Phase::first, first_.root, {}, kRoot, 0, Regions::all(), {}};
    all.triangles.reserve(second_.input.triangles.size());
    for (const TriangleId t : map_.second_triangle) all.triangles.push_back(t);
    steps_.push_back(std::move(all));
    std::size_t ticks = 0;
    while (!steps_.empty()) {
      if (++ticks % kStepsPerQuestion == 0 && options_.progress != nullptr &&
          options_.progress->cancelled()) {
        throw Cancelled();
      }
      Step step = std::move(steps_.back());
      steps_.pop_back();
      if (step.phase == Phase::first) {
        follow_first(step);
      } else {
        follow_second(step);
      }
    }
    report_.nodes = merged_.nodes.size();
    return std::move(merged_);
  }

 private:
  static constexpr std::uint32_t kRoot = ~std::uint32_t{0};

  enum class Phase { first, second };

  struct Step {
    Phase phase;
    TreeRef at;  // in the tree of the phase
    Leaf first;  // in the second phase: what the first tree says of the region
    std::uint32_t parent;
    std::size_t side;
    typename Regions::Region region;
    std::vector<TriangleId> triangles;  // of the second tree, that may reach into the region
  };

  void follow_first(Step& step) {
    if (!step.at.is_leaf()) {
      if (has_one_label(step)) return copy_first(step);
      const TreeNode& node = first_.nodes[step.at.node()];
      return add_node(step, node, node.plane);
    }
    const Leaf& leaf = first_.leaves[step.at.leaf()];
    if (const auto label = decided_by(operation_, leaf.label)) {
      return hang(step.parent, step.side, add_leaf({*label, leaf.confidence}));
    }
    step.phase = Phase::second;
    step.first = leaf;
    step.at = second_.root;
    steps_.push_back(std::move(step));
  }

  void follow_second(Step& step) {
    if (const auto plane = next_cut(step)) {
      return add_node(step, second_.nodes[step.at.node()], *plane);
    }
    hang(step.parent, step.side, add_leaf(combined(step.first, second_.leaves[step.at.leaf()])));
  }

  // Walks down the second tree to the next node that cuts the region into parts that may differ in
  // label, and returns its plane, or to a leaf.
  std::optional<PlaneId> next_cut(Step& step) {
    while (!step.at.is_leaf()) {
      const TreeNode& node = second_.nodes[step.at.node()];
      const PlaneId plane = map_.second_plane[node.plane];
      const Sides sides = regions_->sides(step.region, plane);
      ++report_.regions;
      report_.cut_regions += sides.above && sides.below;
      if (sides.above && sides.below) {
        if (!has_one_label(step)) return plane;
        step.region = regions_->cut(step.region, plane)[0];
      }
      step.at = node.child[sides.above ? 0 : 1];
    }
    return std::nullopt;
  }

  // Whether the second tree says the same of the whole region: then a part of it is enough to find
  // what.
  [[nodiscard]] bool has_one_label(const Step& step) const {
    return options_.sealed && step.triangles.empty();
  }

  // The nodes of the first tree in a region that has one label in the second.
  void copy_first(Step& step) {
    struct Place {
      TreeRef at;
      std::uint32_t parent;
      std::size_t side;
    };
    std::vector<Place> places{{step.at, step.parent, step.side}};
    step.at = second_.root;
    (void)next_cut(step);
    const Leaf& second = second_.leaves[step.at.leaf()];
    while (!places.empty()) {
      const Place place = places.back();
      places.pop_back();
      if (place.at.is_leaf()) {
        const Leaf& first = first_.leaves[place.at.leaf()];
        hang(place.parent, place.side, add_leaf(combined(first, second)));
        continue;
      }
      const TreeNode& node = first_.nodes[place.at.node()];
      TreeNode copy = begin_node(node.plane);
      add_triangles_of_first(node);
      sort_triangles_at_node(copy);
      const NodeId id = merged_.nodes.push_back(copy);
      hang(place.parent, place.side, TreeRef(id));
      for (const std::size_t side : {1u, 0u}) places.push_back({node.child[side], id.value, side});
    }
  }

  [[nodiscard]] Leaf combined(const Leaf& first, const Leaf& second) const {
    return {combine(operation_, first.label, second.label),
            std::min(first.confidence, second.confidence)};
  }

  TreeRef add_leaf(const Leaf& leaf) { return TreeRef(merged_.leaves.push_back(leaf)); }

  void hang(std::uint32_t parent, std::size_t side, TreeRef ref) {
    if (parent == kRoot) {
      merged_.root = ref;
    } else {
      merged_.nodes[NodeId(parent)].child[side] = ref;
    }
  }

  // Its triangles are those that node_triangles gets from now on.
  [[nodiscard]] TreeNode begin_node(PlaneId plane) const {
    TreeNode node;
    node.plane = plane;
    node.first_triangle = begin_of_list(merged_.node_triangles.size(), 0);
    return node;
  }

  void add_triangles_of_first(const TreeNode& node) {
    for (std::uint32_t i = 0; i < node.triangle_count; ++i) {
      const TriangleId t = first_.node_triangles[node.first_triangle + i];
      merged_.node_triangles.push_back(map_.first_triangle[t]);
    }
  }

  void add_node(Step& step, const TreeNode& node, PlaneId plane) {
    TreeNode added = begin_node(plane);
    if (step.phase == Phase::first) add_triangles_of_first(node);
    std::array<std::vector<TriangleId>, 2> parts = part_triangles(step.triangles, plane);
    sort_triangles_at_node(added);
    const NodeId id = merged_.nodes.push_back(added);
    hang(step.parent, step.side, TreeRef(id));
    const auto regions = regions_->cut(step.region, plane);
    for (const std::size_t side : {1u, 0u}) {
      steps_.push_back({step.phase, node.child[side], step.first, id.value, side, regions[side],
                        std::move(parts[side])});
    }
  }

  // Those in the plane go to the node at hand.
  std::array<std::vector<TriangleId>, 2> part_triangles(const std::vector<TriangleId>& triangles,
                                                        PlaneId plane_id) {
    std::array<std::vector<TriangleId>, 2> parts;
    const Plane& plane = merged_.input.planes[plane_id];
    for (const TriangleId t : triangles) {
      const Triangle& triangle = merged_.input.triangles[t];
      if (triangle.plane == plane_id) {
        merged_.node_triangles.push_back(t);
        continue;
      }
      bool above = false, below = false;
      for (const PointId corner : triangle.corners) {
        const int side = meshrepair::side(merged_.input.grid_points[corner], plane);
        above |= side > 0;
        below |= side < 0;
      }
      if (above) parts[0].push_back(t);
      if (below) parts[1].push_back(t);
    }
    return parts;
  }

  // A face of both solids is there once.
  void sort_triangles_at_node(TreeNode& node) {
    auto& list = merged_.node_triangles;
    const auto first = list.begin() + static_cast<std::ptrdiff_t>(node.first_triangle);
    std::sort(first, list.end());
    list.erase(std::unique(first, list.end()), list.end());
    const std::size_t count = list.size() - node.first_triangle;
    node.first_triangle = begin_of_list(node.first_triangle, count);
    node.triangle_count = static_cast<std::uint32_t>(count);
  }

  const Tree& first_;
  const Tree& second_;
  SetOperation operation_;
  const MergeOptions& options_;
  MergeReport& report_;
  internal::JoinMap map_;
  Tree merged_;
  Regions* regions_ = nullptr;
  std::vector<Step> steps_;
};

}  // namespace

Tree merge_trees(const Tree& first, const Tree& second, SetOperation operation,
                 const MergeOptions& options, MergeReport& report) {
  require_labels(first);
  require_labels(second);
  report = {};
  Tree merged =
      options.test == RegionTest::cells
          ? Merger<internal::CellRegions>(first, second, operation, options, report).run()
          : Merger<internal::LinearRegions>(first, second, operation, options, report).run();
  Tree collapsed = internal::collapse_tree(std::move(merged));
  report.kept_nodes = collapsed.nodes.size();
  return collapsed;
}

}  // namespace meshrepair
