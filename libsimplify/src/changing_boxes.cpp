// SPDX-License-Identifier: MIT
#include "changing_boxes.h"

#include <base/ids.h>

namespace meshrepair::internal {
namespace {

bool contains(const Box& outer, const Box& inner) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
  }
  return true;
}

}  // namespace

void ChangingBoxes::build(std::span<const std::uint32_t> items, std::span<const Box> boxes,
                          std::size_t end) {
  const BoxTree tree(boxes);
  gone_ = 0;
  nodes_.assign(tree.nodes().begin(), tree.nodes().end());
  parent_.assign(nodes_.size(), kNone);
  order_.clear();
  order_.reserve(items.size());
  for (const std::uint32_t i : tree.order()) order_.push_back(items[i]);
  leaf_of_.resize(end, kNone);
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const BoxNode& node = nodes_[n];
    if (node.is_leaf()) {
      for (std::uint32_t i = 0; i < node.count; ++i) leaf_of_[order_[node.first + i]] = n;
    } else {
      parent_[n + 1] = parent_[node.right] = n;
    }
  }
}

void ChangingBoxes::change(std::uint32_t item, const Box& box) {
  for (std::uint32_t n = leaf_of_[item]; n != kNone && !contains(nodes_[n].box, box);
       n = parent_[n]) {
    nodes_[n].box.add(box);
  }
}

}  // namespace meshrepair::internal
