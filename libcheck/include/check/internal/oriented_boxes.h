// SPDX-License-Identifier: MIT
// Boxes along the triangles in them, whatever their directions: they tell long ones apart that
// boxes along the coordinate axes do not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <check/box_tree.h>

namespace meshrepair::internal {

// Would boxes along the coordinate axes tell little apart: does one meet very many others, told by
// a sample? Pairs of which is_left_out(i, j) is true do not count. `tree` is that of the boxes.
template <class IsLeftOut>
[[nodiscard]] bool boxes_tell_little(const BoxTree& tree, std::span<const Box> boxes,
                                     const IsLeftOut& is_left_out) {
  constexpr std::size_t kSamples = 256;
  // On a common mesh it is about 15.
  constexpr std::size_t kManyNeighbours = 64;
  if (boxes.size() < kSamples * kManyNeighbours / 16) return false;
  std::size_t neighbours = 0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const auto sample = static_cast<std::uint32_t>(k * boxes.size() / kSamples);
    tree.visit([&](const Box& box) { return box.meets(boxes[sample]); },
               [&](std::uint32_t other) {
                 if (!boxes[other].meets(boxes[sample]) || is_left_out(sample, other)) return;
                 ++neighbours;
               });
  }
  return neighbours > kSamples * kManyNeighbours;
}

// Around the triangles of each node of a tree. Rounded, with a margin far larger than the errors:
// where two boxes do not meet, no triangle of the one meets one of the other.
class OrientedBoxes {
 public:
  // `corners` are those of the triangles in the order of the tree's leaves, three of each. They are
  // finite, and n log n is spent on them.
  OrientedBoxes(const BoxTree& tree, std::vector<Vec3d> corners);

  // Are the boxes of two nodes no farther apart than this?
  [[nodiscard]] bool are_within(double distance, std::uint32_t node_a, std::uint32_t node_b) const;

 private:
  struct OrientedBox {
    Eigen::Matrix3d axes;  // columns, of length 1
    Vec3d centre;
    Vec3d half;  // the lengths along the axes
  };

  [[nodiscard]] static OrientedBox around(std::span<const Vec3d> points);

  std::vector<OrientedBox> boxes_;
  double unit_ = 1;  // the length of 1 in their numbers
};

}  // namespace meshrepair::internal
