// SPDX-License-Identifier: MIT
#include <algorithm>

#include <base/parallel.h>
#include <check/box_tree.h>

namespace meshrepair {
namespace {

// Below this a thread of its own costs more than it saves.
constexpr std::uint32_t kParallelItems = 4096;

struct Entry {
  std::array<double, 3> centre;
  std::uint32_t item;
};

// A range of n items becomes ceil(n / kLeafItems) leaves, all full but the last, so that the number
// of nodes of each subtree, and with it the place of every node, is known before it is built.
std::uint32_t leaves_of(std::uint32_t items) {
  return (items + BoxTree::kLeafItems - 1) / BoxTree::kLeafItems;
}

class TreeBuilder {
 public:
  TreeBuilder(std::span<const Box> boxes, std::span<Entry> entries, std::span<BoxNode> nodes)
      : boxes_(boxes), entries_(entries), nodes_(nodes) {}

  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
    nodes_[node] = {Box(), first, count, 0};
    const std::uint32_t leaves = leaves_of(count);
    if (leaves == 1) {
      // Else the order in a leaf would be that of nth_element(), which libraries choose.
      std::sort(entries_.begin() + first, entries_.begin() + first + count,
                [](const Entry& a, const Entry& b) { return a.item < b.item; });
      for (std::uint32_t i = first; i < first + count; ++i) {
        nodes_[node].box.add(boxes_[entries_[i].item]);
      }
      return;
    }
    const std::uint32_t left_leaves = leaves / 2;
    const std::uint32_t left_count = left_leaves * BoxTree::kLeafItems;
    const std::uint32_t right = node + 2 * left_leaves;
    nodes_[node].right = right;
    split(first, count, left_count);
    const auto build_left = [&] { build(node + 1, first, left_count); };
    const auto build_right = [&] { build(right, first + left_count, count - left_count); };
    if (count >= kParallelItems) {
      parallel_invoke(build_left, build_right);
    } else {
      build_left();
      build_right();
    }
    nodes_[node].box = nodes_[node + 1].box;
    nodes_[node].box.add(nodes_[right].box);
  }

 private:
  void split(std::uint32_t first, std::uint32_t count, std::uint32_t left_count) {
    const auto begin = entries_.begin() + first;
    const std::size_t axis = widest_axis(first, count);
    std::nth_element(begin, begin + left_count, begin + count,
                     [axis](const Entry& a, const Entry& b) {
                       if (a.centre[axis] != b.centre[axis]) return a.centre[axis] < b.centre[axis];
                       return a.item < b.item;
                     });
  }

  [[nodiscard]] std::size_t widest_axis(std::uint32_t first, std::uint32_t count) const {
    std::array<double, 3> low = entries_[first].centre;
    std::array<double, 3> high = low;
    for (std::uint32_t i = first; i < first + count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], entries_[i].centre[k]);
        high[k] = std::max(high[k], entries_[i].centre[k]);
      }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    }
    return axis;
  }

  std::span<const Box> boxes_;
  std::span<Entry> entries_;
  std::span<BoxNode> nodes_;
};

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  const auto count = static_cast<std::uint32_t>(boxes.size());
  RawVector<Entry> entries(count);
  parallel_tasks(count, kParallelItems, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      entries[i].item = static_cast<std::uint32_t>(i);
      for (std::size_t k = 0; k < 3; ++k) {
        // Halved first: the sum of two large numbers may overflow.
        entries[i].centre[k] = 0.5 * boxes[i].low[k] + 0.5 * boxes[i].high[k];
      }
    }
  });
  nodes_.resize(2 * std::size_t{leaves_of(count)} - 1);
  TreeBuilder(boxes, entries, nodes_).build(0, 0, count);
  order_.resize(count);
  parallel_tasks(count, kParallelItems, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) order_[i] = entries[i].item;
  });
}

}  // namespace meshrepair
