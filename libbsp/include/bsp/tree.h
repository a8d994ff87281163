// SPDX-License-Identifier: MIT
// The binary space partition: planes at the inner nodes, convex regions at the leaves.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <base/ids.h>
#include <bsp/clean_soup.h>

namespace meshrepair {

// A child of a node: an inner node or a leaf.
class TreeRef {
 public:
  TreeRef() = default;
  explicit TreeRef(NodeId node) : bits_(node.value) {}
  explicit TreeRef(LeafId leaf) : bits_(leaf.value | kLeafBit) {}
  static TreeRef from_bits(std::uint32_t bits) {
    TreeRef ref;
    ref.bits_ = bits;
    return ref;
  }

  [[nodiscard]] bool is_leaf() const { return (bits_ & kLeafBit) != 0; }
  [[nodiscard]] NodeId node() const { return NodeId(bits_); }
  [[nodiscard]] LeafId leaf() const { return LeafId(bits_ & ~kLeafBit); }
  [[nodiscard]] std::uint32_t bits() const { return bits_; }

 private:
  static constexpr std::uint32_t kLeafBit = std::uint32_t{1} << 31;
  std::uint32_t bits_ = kLeafBit;  // leaf 0: a tree without nodes
};

struct TreeNode {
  PlaneId plane;
  std::array<TreeRef, 2> child;  // child 0 is the side where the plane's normal points
  // The input triangles that lie in this plane and have area inside the node's region:
  // a range of Tree::node_triangles.
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
};

enum class Label : std::uint8_t { unknown = 0, empty = 1, solid = 2 };

struct Leaf {
  Label label = Label::unknown;
  float confidence =
      0;  // |s| of the solidity, or the distance of the winding from 1/2, doubled; 0 to 1
};

// Invariants: every node and every leaf is referred to exactly once (by a parent or as the root),
// parents stand before their children, and each plane cuts the region of its node into two parts
// with volume.
struct Tree {
  CleanSoup input;  // its plane table holds the planes of the nodes as well
  TreeRef root;
  IdVector<NodeId, TreeNode> nodes;
  std::vector<TriangleId> node_triangles;
  IdVector<LeafId, Leaf> leaves;
};

}  // namespace meshrepair
