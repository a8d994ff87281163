// SPDX-License-Identifier: MIT
// Building the tree.
//
// Idea: the first nodes are the planes of the input's bounding box, so that what lies beside it is
// cut off, and an opening that is flush with the box (a cup, half a body) has a plane that can
// close it. Then a region with many fragments is cut across an axis where that separates them; a
// small one is cut by the plane of one of its fragments, and all fragments in that plane stay at
// the node. What is left goes, cut where necessary, to the two sides. A region without fragments is
// a leaf.
//
// Parts of the tree are built by several threads (subtree.cpp) and joined here, numbered as if one
// had built it from the root on, the front of each node before its back.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <bsp/build_tree.h>

#include "subtree.h"

namespace meshrepair {
namespace {

using internal::BoxPlane;
using internal::Extent;
using internal::PutOff;
using internal::Subtree;

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

// From these ids of a subtree on, so much is added to them in the tree.
struct Shift {
  std::size_t from = 0, add = 0;
};

class Shifts {
 public:
  // `first` is the place of id 0.
  explicit Shifts(std::size_t first) : shifts_{{0, first}} {}

  void insert(std::size_t before, std::size_t count) {
    shifts_.push_back({before, shifts_.back().add + count});
  }

  [[nodiscard]] std::size_t operator()(std::size_t id) const {
    const auto behind =
        std::upper_bound(shifts_.begin(), shifts_.end(), id,
                         [](std::size_t one, const Shift& shift) { return one < shift.from; });
    return id + (behind - 1)->add;
  }

 private:
  std::vector<Shift> shifts_;
};

class SubtreeJoiner {
 public:
  explicit SubtreeJoiner(Tree& tree) : tree_(tree), soup_planes_(tree.input.planes.size()) {}

  // Appends a subtree, each part that was put off where its turn came.
  TreeRef append(Subtree subtree) {
    Joined joined{Shifts(tree_.nodes.size()), Shifts(tree_.leaves.size()), {}};
    for (const PutOff& part : subtree.put_off) {
      joined.nodes.insert(part.before.nodes, part.subtree.report.nodes);
      joined.leaves.insert(part.before.leaves, part.subtree.report.leaves);
    }
    Extent from;
    for (PutOff& part : subtree.put_off) {
      append_between(subtree, from, part.before, joined);
      const TreeRef root = append(std::move(part.subtree));
      TreeNode& parent = tree_.nodes[NodeId(joined.nodes(part.region.parent.index()))];
      parent.child[static_cast<std::size_t>(part.region.side)] = root;
      from = part.before;
    }
    append_between(subtree, from, extent_of(subtree), joined);
    return place_of(subtree.root, joined);
  }

 private:
  // Where the elements of a subtree are in the tree.
  struct Joined {
    Shifts nodes, leaves;
    std::vector<PlaneId> planes;
  };

  [[nodiscard]] static TreeRef place_of(TreeRef ref, const Joined& joined) {
    if (ref.is_leaf()) return TreeRef(LeafId(joined.leaves(ref.leaf().index())));
    return TreeRef(NodeId(joined.nodes(ref.node().index())));
  }

  void append_between(const Subtree& subtree, const Extent& from, const Extent& to,
                      Joined& joined) {
    for (std::size_t i = from.planes; i < to.planes; ++i) {
      joined.planes.push_back(tree_.input.planes.intern(subtree.planes[i]).id);
    }
    const std::uint32_t triangles =
        begin_of_list(tree_.node_triangles.size(), to.triangles - from.triangles);
    for (std::size_t i = from.nodes; i < to.nodes; ++i) {
      TreeNode node = subtree.nodes[NodeId(i)];
      if (node.plane.index() >= soup_planes_) {
        node.plane = joined.planes[node.plane.index() - soup_planes_];
      }
      node.first_triangle += triangles - static_cast<std::uint32_t>(from.triangles);
      for (TreeRef& child : node.child) child = place_of(child, joined);
      tree_.nodes.push_back(node);
    }
    const auto at = [&](std::size_t i) {
      return subtree.node_triangles.begin() + static_cast<std::ptrdiff_t>(i);
    };
    tree_.node_triangles.insert(tree_.node_triangles.end(), at(from.triangles), at(to.triangles));
    for (std::size_t i = from.leaves; i < to.leaves; ++i) {
      tree_.leaves.push_back(subtree.leaves[LeafId(i)]);
    }
  }

  Tree& tree_;
  std::size_t soup_planes_;
};

}  // namespace

Tree build_tree(CleanSoup soup, const BuildTreeOptions& options, BuildTreeReport& report) {
  Tree tree{std::move(soup), {}, {}, {}, {}};
  const std::vector<BoxPlane> sides = planes_of_bounding_box(tree.input);
  internal::TreeProgress progress(options.progress, tree.input.triangles.size());
  Subtree whole = internal::build_whole({tree.input, options, progress}, sides);
  report = whole.report;
  tree.nodes.reserve(report.nodes);
  tree.leaves.reserve(report.leaves);
  tree.node_triangles.reserve(report.fragments);
  tree.root = SubtreeJoiner(tree).append(std::move(whole));
  tree.input.planes.release_index();
  return tree;
}

}  // namespace meshrepair
