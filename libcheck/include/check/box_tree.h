// SPDX-License-Identifier: MIT
// A tree of axis-parallel boxes over any items: which items are near a place, without looking at
// all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <base/raw_vector.h>
#include <mesh/soup.h>

namespace meshrepair {

// Closed; empty until something is added.
struct Box {
  std::array<double, 3> low = {std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::infinity()};
  std::array<double, 3> high = {-std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()};

  void add(const Vec3d& point) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = point[static_cast<Eigen::Index>(k)];
      low[k] = x < low[k] ? x : low[k];
      high[k] = x > high[k] ? x : high[k];
    }
  }
  void add(const Box& box) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = box.low[k] < low[k] ? box.low[k] : low[k];
      high[k] = box.high[k] > high[k] ? box.high[k] : high[k];
    }
  }
  // Larger by so much on all sides.
  void widen(double by) {
    for (double& x : low) x -= by;
    for (double& x : high) x += by;
  }
  // Its length; no number where the box is empty.
  [[nodiscard]] double diagonal() const {
    return Vec3d(high[0] - low[0], high[1] - low[1], high[2] - low[2]).norm();
  }
  // To its nearest point; 0 within.
  [[nodiscard]] double squared_distance(const Vec3d& point) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = point[static_cast<Eigen::Index>(k)];
      const double below = low[k] - x, above = x - high[k];
      const double beyond = below > above ? below : above;
      if (beyond > 0) sum += beyond * beyond;
    }
    return sum;
  }
  // Have the two a point in common?
  [[nodiscard]] bool meets(const Box& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
           other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
  }
};

// A node's left child follows it. Its items are order()[first] to order()[first + count - 1].
struct BoxNode {
  Box box;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t right = 0;  // the right child; 0: a leaf

  [[nodiscard]] bool is_leaf() const { return right == 0; }
};

// The items of all leaves, in `order`, whose boxes, and those above, `reaches(box)` says yes to;
// the items' own boxes are not asked about. The nodes are those of a BoxTree, or have grown since.
template <class Reaches, class Visit>
void visit_boxes(std::span<const BoxNode> nodes, std::span<const std::uint32_t> order,
                 const Reaches& reaches, const Visit& visit_item) {
  constexpr std::size_t kMostDepth = 32;  // of 2^32 items, halved each time
  if (nodes.empty()) return;
  std::array<std::uint32_t, kMostDepth + 1> stack{};
  std::size_t waiting = 1;
  while (waiting > 0) {
    const std::uint32_t n = stack[--waiting];
    const BoxNode& node = nodes[n];
    if (!reaches(node.box)) continue;
    if (node.is_leaf()) {
      for (std::uint32_t i = 0; i < node.count; ++i) visit_item(order[node.first + i]);
    } else {
      stack[waiting++] = node.right;
      stack[waiting++] = n + 1;
    }
  }
}

// Split at the median of the boxes' centres along the axis where these spread most, so the depth is
// logarithmic whatever the input. The same boxes give the same tree on any number of threads.
class BoxTree {
 public:
  static constexpr std::uint32_t kLeafItems = 4;

  // Items are 0 to boxes.size() - 1. All boxes are finite and not empty. n log n.
  explicit BoxTree(std::span<const Box> boxes);

  // In preorder; empty if there are no items.
  [[nodiscard]] std::span<const BoxNode> nodes() const { return nodes_; }
  // The items by their place in the leaves.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }

  // As visit_boxes().
  template <class Reaches, class Visit>
  void visit(const Reaches& reaches, const Visit& visit_item) const {
    visit_boxes(nodes_, order_, reaches, visit_item);
  }

 private:
  RawVector<BoxNode> nodes_;
  RawVector<std::uint32_t> order_;
};

// Does the box meet one of `boxes`, which the tree was made of?
[[nodiscard]] inline bool meets_any(const BoxTree& tree, std::span<const Box> boxes,
                                    const Box& box) {
  bool any = false;
  tree.visit([&](const Box& other) { return !any && other.meets(box); },
             [&](std::uint32_t i) { any = any || boxes[i].meets(box); });
  return any;
}

}  // namespace meshrepair
