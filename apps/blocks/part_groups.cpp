#include "blocks/part_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <base/disjoint_sets.h>
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

double diagonal_of(const Box& box) {
  const double across = std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  return std::hypot(across, box.high[2] - box.low[2]);  // three at a time make NaN of infinity
}

// It stays finite.
Box widened(Box box, double by) {
  constexpr double kMost = std::numeric_limits<double>::max();
  box.widen(by);
  for (double& x : box.low) x = std::max(x, -kMost);
  for (double& x : box.high) x = std::min(x, kMost);
  return box;
}

// Joins what the boxes of parts say. Those that are empty stay alone.
DisjointSets joined_parts(const std::vector<Box>& boxes, double margin) {
  std::vector<Box> wide;
  std::vector<std::uint32_t> part;
  for (std::uint32_t p = 0; p < boxes.size(); ++p) {
    if (is_empty(boxes[p])) continue;
    part.push_back(p);
    wide.push_back(widened(boxes[p], margin * diagonal_of(boxes[p])));
  }
  DisjointSets sets(boxes.size());
  const BoxTree tree(wide);
  for (std::uint32_t i = 0; i < wide.size(); ++i) {
    tree.visit([&](const Box& other) { return other.meets(wide[i]); },
               [&](std::uint32_t k) {
                 if (k < i && wide[k].meets(wide[i])) sets.join(part[i], part[k]);
               });
  }
  return sets;
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
  DisjointSets sets = joined_parts(boxes, margin);
  std::vector<std::uint32_t> group_of_root(parts.count, kNoGroup);
  PartGroups groups;
  groups.of_triangle.reserve(soup.triangles.size());
  for (const std::uint32_t part : parts.of_triangle) {
    std::uint32_t& group = group_of_root[sets.root(part)];
    if (group == kNoGroup) {
      group = static_cast<std::uint32_t>(groups.size());
      groups.box.emplace_back();
      groups.triangles.push_back(0);
    }
    groups.of_triangle.push_back(group);
    ++groups.triangles[group];
  }
  for (std::uint32_t p = 0; p < parts.count; ++p) {
    groups.box[group_of_root[sets.root(p)]].add(boxes[p]);
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
