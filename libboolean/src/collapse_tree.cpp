// SPDX-License-Identifier: MIT
#include "collapse_tree.h"

#include <algorithm>
#include <vector>

namespace meshrepair::internal {
namespace {

class Collapser {
 public:
  explicit Collapser(Tree tree) : tree_(std::move(tree)) {}

  Tree run() {
    find_leaves();
    Tree collapsed;
    collapsed.input = std::move(tree_.input);
    struct Step {
      TreeRef from;
      std::uint32_t node;  // where the copy is referred to; the root's is no node
      std::size_t side;
    };
    std::vector<Step> stack = {{reduced(tree_.root), kRoot, 0}};
    while (!stack.empty()) {
      const Step step = stack.back();
      stack.pop_back();
      const TreeRef copy = copy_of(step.from, collapsed);
      if (step.node == kRoot) {
        collapsed.root = copy;
      } else {
        collapsed.nodes[NodeId(step.node)].child[step.side] = copy;
      }
      if (step.from.is_leaf()) continue;
      const TreeNode& node = tree_.nodes[step.from.node()];
      for (const std::size_t side : {1u, 0u}) {
        stack.push_back({reduced(node.child[side]), copy.node().value, side});
      }
    }
    return collapsed;
  }

 private:
  static constexpr std::uint32_t kRoot = ~std::uint32_t{0};

  // Children stand behind their parents.
  void find_leaves() {
    becomes_.assign(tree_.nodes.size(), TreeRef());
    for (std::size_t n = tree_.nodes.size(); n-- > 0;) {
      const NodeId id(n);
      becomes_[id] = TreeRef(id);
      const TreeRef a = reduced(tree_.nodes[id].child[0]);
      const TreeRef b = reduced(tree_.nodes[id].child[1]);
      if (!a.is_leaf() || !b.is_leaf()) continue;
      Leaf& leaf = tree_.leaves[a.leaf()];
      const Leaf& other = tree_.leaves[b.leaf()];
      if (leaf.label != other.label) continue;
      leaf.confidence = std::min(leaf.confidence, other.confidence);
      becomes_[id] = a;
    }
  }

  [[nodiscard]] TreeRef reduced(TreeRef ref) const {
    return ref.is_leaf() ? ref : becomes_[ref.node()];
  }

  TreeRef copy_of(TreeRef from, Tree& to) const {
    if (from.is_leaf()) return TreeRef(to.leaves.push_back(tree_.leaves[from.leaf()]));
    TreeNode node = tree_.nodes[from.node()];
    const auto first =
        tree_.node_triangles.begin() + static_cast<std::ptrdiff_t>(node.first_triangle);
    node.first_triangle = begin_of_list(to.node_triangles.size(), node.triangle_count);
    to.node_triangles.insert(to.node_triangles.end(), first,
                             first + static_cast<std::ptrdiff_t>(node.triangle_count));
    return TreeRef(to.nodes.push_back(node));
  }

  Tree tree_;
  IdVector<NodeId, TreeRef> becomes_;
};

}  // namespace

Tree collapse_tree(Tree tree) { return Collapser(std::move(tree)).run(); }

}  // namespace meshrepair::internal
