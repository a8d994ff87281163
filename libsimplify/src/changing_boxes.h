// SPDX-License-Identifier: MIT
// Which boxes are near a place, while some change and some go?
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <check/box_tree.h>

namespace meshrepair::internal {

// A tree of boxes whose nodes grow with what changes below them. It is to be built anew now and
// then: see is_worn().
class ChangingBoxes {
 public:
  // `items` are numbers below `end`, `boxes` those of each of them, in their order.
  void build(std::span<const std::uint32_t> items, std::span<const Box> boxes, std::size_t end);

  // The item's box is this by now.
  void change(std::uint32_t item, const Box& box);
  // Items that go are visited all the same.
  void note_gone(std::size_t count) { gone_ += count; }
  // Half of the items are gone: building it anew pays.
  [[nodiscard]] bool is_worn() const { return 2 * gone_ > order_.size(); }

  // At least the items whose boxes meet this one, and others. Each once.
  template <class Visit>
  void visit(const Box& box, const Visit& visit_item) const {
    visit_boxes(
        nodes_, order_, [&](const Box& node) { return node.meets(box); }, visit_item);
  }

 private:
  std::vector<BoxNode> nodes_;
  std::vector<std::uint32_t> parent_;  // of each node
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> leaf_of_;  // of each item
  std::size_t gone_ = 0;
};

}  // namespace meshrepair::internal
