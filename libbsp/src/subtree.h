// SPDX-License-Identifier: MIT
// A part of the tree that is built on its own: what else is built does not matter to it.
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include <bsp/build_tree.h>
#include <bsp/tree.h>

#include "fragment_pool.h"

namespace meshrepair::internal {

// A region and its fragments, a range of a stack of fragment ids up to its top.
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

// How much of a subtree there is.
struct Extent {
  std::size_t nodes = 0, leaves = 0, triangles = 0, planes = 0;
};

struct PutOff;

// Its ids count from 0. A plane that is not of the soup has as its id the number of those of the
// soup, and its place in `planes`.
struct Subtree {
  TreeRef root;
  IdVector<NodeId, TreeNode> nodes;
  std::vector<TriangleId> node_triangles;
  IdVector<LeafId, Leaf> leaves;
  std::vector<Plane> planes;    // that were tried, in that order
  std::vector<PutOff> put_off;  // in the order in which their turn came
  BuildTreeReport report;       // the numbers of nodes, leaves and fragments with those put off
};

// What was put off hangs at a node of the subtree around it, and stands between its elements there.
struct PutOff {
  Region region;
  std::vector<FragmentId> fragments;  // until it is built
  Extent before;                      // what there was when its turn came
  Subtree subtree;
};

[[nodiscard]] inline Extent extent_of(const Subtree& subtree) {
  return {subtree.nodes.size(), subtree.leaves.size(), subtree.node_triangles.size(),
          subtree.planes.size()};
}

// For all subtrees together: counts the fragments that are done.
class TreeProgress {
 public:
  TreeProgress(ProgressObserver* observer, std::size_t fragments)
      : observer_(observer), fragments_(fragments > 0 ? fragments : 1) {}

  // So many more. Throws Cancelled when the observer says so.
  void add(std::size_t done);

 private:
  ProgressObserver* observer_;
  std::size_t fragments_;
  std::size_t done_ = 0;
  std::mutex mutex_;
};

// What subtrees have in common. None of it changes meanwhile, but for the progress.
struct TreeTask {
  const CleanSoup& soup;  // its planes can be looked up
  const BuildTreeOptions& options;
  TreeProgress& progress;
};

// The whole tree. `sides` are the planes of the soup's bounding box.
[[nodiscard]] Subtree build_whole(const TreeTask& task, const std::vector<BoxPlane>& sides);

}  // namespace meshrepair::internal
