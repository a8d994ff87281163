// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <base/roots.h>
#include <check/box_tree.h>
#include <check/part_groups.h>
#include <mesh/mesh_parts.h>

namespace meshrepair {
namespace {

constexpr std::uint32_t kNoGroup = ~std::uint32_t{0};

bool is_empty(const Box& box) { return !(box.low[0] <= box.high[0]); }

// Eigen's own test says no of the largest number.
bool is_finite(const Vec3d& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

std::vector<Box> boxes_of(const TriangleSoup& soup, const MeshParts& parts) {
  std::vector<Box> boxes(parts.count);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (const std::uint32_t p : soup.triangles[t]) {
      if (is_finite(soup.points[p])) boxes[parts.of_triangle[t]].add(soup.points[p]);
    }
  }
  return boxes;
}

double length_across(const Box& box) {
  const double across = hypotenuse(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  return hypotenuse(across, box.high[2] - box.low[2]);  // three at a time make NaN of infinity
}

// It stays finite.
Box widened(Box box, double by) {
  constexpr double kMost = std::numeric_limits<double>::max();
  box.widen(by);
  for (double& x : box.low) x = std::max(x, -kMost);
  for (double& x : box.high) x = std::min(x, kMost);
  return box;
}

// Boxes that are in no group yet.
class LooseBoxes {
 public:
  // `boxes` stay where they are.
  explicit LooseBoxes(std::span<const Box> boxes)
      : tree_(boxes), boxes_(boxes), left_(tree_.nodes().size()), is_taken_(boxes.size(), 0) {
    for (std::size_t n = left_.size(); n-- > 0;) {
      const BoxNode& node = tree_.nodes()[n];
      left_[n] = node.is_leaf() ? node.count : left_[n + 1] + left_[node.right];
    }
  }

  [[nodiscard]] bool is_taken(std::uint32_t box) const { return is_taken_[box] != 0; }
  // Appends those that meet this box to `taken`, and does not find them again.
  void take(const Box& box, std::vector<std::uint32_t>& taken) {
    if (!left_.empty()) take(0, box, taken);
  }

 private:
  // How many they were below this node.
  std::uint32_t take(std::uint32_t n, const Box& box, std::vector<std::uint32_t>& taken) {
    const BoxNode& node = tree_.nodes()[n];
    if (left_[n] == 0 || !node.box.meets(box)) return 0;
    std::uint32_t count = 0;
    if (node.is_leaf()) {
      for (const std::uint32_t i : tree_.order().subspan(node.first, node.count)) {
        if (is_taken(i) || !boxes_[i].meets(box)) continue;
        is_taken_[i] = 1;
        taken.push_back(i);
        ++count;
      }
    } else {
      count = take(n + 1, box, taken) + take(node.right, box, taken);
    }
    left_[n] -= count;
    return count;
  }

  BoxTree tree_;
  std::span<const Box> boxes_;
  std::vector<std::uint32_t> left_;  // of each node, how many boxes below it are not taken
  std::vector<char> is_taken_;
};

// Of each box, the lowest of those that it meets, itself or by others.
std::vector<std::uint32_t> lowest_connected(std::span<const Box> boxes) {
  std::vector<std::uint32_t> lowest(boxes.size());
  LooseBoxes loose(boxes);
  std::vector<std::uint32_t> group;
  for (std::uint32_t first = 0; first < boxes.size(); ++first) {
    if (loose.is_taken(first)) continue;
    group.clear();
    loose.take(boxes[first], group);
    for (std::size_t i = 0; i < group.size(); ++i) {
      lowest[group[i]] = first;
      loose.take(boxes[group[i]], group);
    }
  }
  return lowest;
}

// Of each part, the lowest of those that it belongs together with. Those with an empty box stay
// alone.
std::vector<std::uint32_t> lowest_of_group(const std::vector<Box>& boxes, double margin) {
  std::vector<Box> wide;
  std::vector<std::uint32_t> part;
  std::vector<std::uint32_t> lowest(boxes.size());
  for (std::uint32_t p = 0; p < boxes.size(); ++p) {
    lowest[p] = p;
    if (is_empty(boxes[p])) continue;
    part.push_back(p);
    wide.push_back(widened(boxes[p], margin * length_across(boxes[p])));
  }
  const std::vector<std::uint32_t> connected = lowest_connected(wide);
  for (std::size_t i = 0; i < part.size(); ++i) lowest[part[i]] = part[connected[i]];
  return lowest;
}

// The bits of three numbers of 21 bits by turns: near numbers are near along this curve, mostly.
std::uint64_t place_on_curve(const std::array<std::uint64_t, 3>& at) {
  std::uint64_t place = 0;
  for (unsigned bit = 21; bit-- > 0;) {
    for (const std::uint64_t x : at) place = place << 1 | (x >> bit & 1);
  }
  return place;
}

std::uint64_t place_of(const Box& box, const Box& all) {
  constexpr double kSteps = (1 << 21) - 1;
  std::array<std::uint64_t, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = all.high[k] / 2 - all.low[k] / 2;  // half of it: no overflow
    const double from =
        (box.low[k] / 2 - all.low[k] / 2) / 2 + (box.high[k] / 2 - all.low[k] / 2) / 2;
    if (side > 0) at[k] = static_cast<std::uint64_t>(std::clamp(from / side, 0.0, 1.0) * kSteps);
  }
  return place_on_curve(at);
}

}  // namespace

PartGroups find_groups(const TriangleSoup& soup, double margin) {
  const MeshParts parts = find_parts(soup);
  const std::vector<Box> boxes = boxes_of(soup, parts);
  const std::vector<std::uint32_t> lowest = lowest_of_group(boxes, margin);
  std::vector<std::uint32_t> group_of_lowest(parts.count, kNoGroup);
  PartGroups groups;
  groups.of_triangle.reserve(soup.triangles.size());
  for (const std::uint32_t part : parts.of_triangle) {
    std::uint32_t& group = group_of_lowest[lowest[part]];
    if (group == kNoGroup) {
      group = static_cast<std::uint32_t>(groups.size());
      groups.box.emplace_back();
      groups.triangles.push_back(0);
    }
    groups.of_triangle.push_back(group);
    ++groups.triangles[group];
  }
  for (std::uint32_t p = 0; p < parts.count; ++p) {
    groups.box[group_of_lowest[lowest[p]]].add(boxes[p]);
  }
  return groups;
}

std::vector<std::uint32_t> divide_into_blocks(const PartGroups& groups,
                                              std::size_t most_triangles) {
  Box all;
  for (const Box& box : groups.box) all.add(box);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    order.emplace_back(is_empty(groups.box[g]) ? 0 : place_of(groups.box[g], all), g);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> block_of(groups.size());
  std::uint32_t block = 0;
  std::size_t in_block = 0;
  for (const auto& [place, g] : order) {
    if (in_block > 0 && in_block + groups.triangles[g] > most_triangles) {
      ++block;
      in_block = 0;
    }
    block_of[g] = block;
    in_block += groups.triangles[g];
  }
  return block_of;
}

}  // namespace meshrepair
