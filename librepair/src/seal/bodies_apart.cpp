// SPDX-License-Identifier: MIT
#include "bodies_apart.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <base/ids.h>
#include <base/roots.h>
#include <check/box_tree.h>

namespace meshrepair::internal {
namespace {

std::vector<Box> boxes_of(const TriangleSoup& mesh, const MeshParts& parts) {
  std::vector<Box> boxes(parts.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t p : mesh.triangles[t]) boxes[parts.of_triangle[t]].add(mesh.points[p]);
  }
  return boxes;
}

class Divider {
 public:
  Divider(std::span<const Box> boxes, double gap, bool is_share)
      : boxes_(boxes), gap_(gap), is_share_(is_share), group_of_(boxes.size(), 0) {}

  // The group of each box.
  std::vector<std::uint32_t> run() {
    std::vector<std::uint32_t> all(boxes_.size());
    for (std::uint32_t b = 0; b < all.size(); ++b) all[b] = b;
    waiting_.push_back(std::move(all));
    while (!waiting_.empty()) {
      const std::vector<std::uint32_t> among = std::move(waiting_.back());
      waiting_.pop_back();
      if (divide(among)) continue;
      for (const std::uint32_t b : among) group_of_[b] = groups_;
      ++groups_;
    }
    return std::move(group_of_);
  }

 private:
  // At all gaps along the first axis that has some.
  bool divide(std::vector<std::uint32_t> among) {
    const double gap = gap_among(among);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::sort(among.begin(), among.end(), [&](std::uint32_t a, std::uint32_t b) {
        return boxes_[a].low[axis] < boxes_[b].low[axis];
      });
      if (cut(among, axis, gap)) return true;
    }
    return false;
  }

  bool cut(const std::vector<std::uint32_t>& sorted, std::size_t axis, double gap) {
    std::size_t first = 0;
    double end = boxes_[sorted[0]].high[axis];
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (boxes_[sorted[i]].low[axis] - end > gap) {
        waiting_.emplace_back(sorted.begin() + static_cast<std::ptrdiff_t>(first),
                              sorted.begin() + static_cast<std::ptrdiff_t>(i));
        first = i;
      }
      end = std::max(end, boxes_[sorted[i]].high[axis]);
    }
    if (first == 0) return false;
    waiting_.emplace_back(sorted.begin() + static_cast<std::ptrdiff_t>(first), sorted.end());
    return true;
  }

  [[nodiscard]] double gap_among(std::span<const std::uint32_t> among) const {
    if (!is_share_) return gap_;
    double largest = 0;
    for (const std::uint32_t b : among) {
      const Box& box = boxes_[b];
      largest = std::max(largest, stable_length({box.high[0] - box.low[0], box.high[1] - box.low[1],
                                                 box.high[2] - box.low[2]}));
    }
    return gap_ * largest;
  }

  std::span<const Box> boxes_;
  double gap_;
  bool is_share_;
  std::vector<std::vector<std::uint32_t>> waiting_;
  std::vector<std::uint32_t> group_of_;
  std::uint32_t groups_ = 0;
};

}  // namespace

MeshParts bodies_apart(const TriangleSoup& mesh, double gap, bool is_share) {
  MeshParts bodies = find_parts(mesh);
  const std::vector<std::uint32_t> group_of = Divider(boxes_of(mesh, bodies), gap, is_share).run();
  std::vector<std::uint32_t> number(group_of.size(), kNone);
  bodies.count = 0;
  for (std::uint32_t& part : bodies.of_triangle) {
    std::uint32_t& n = number[group_of[part]];
    if (n == kNone) n = bodies.count++;
    part = n;
  }
  return bodies;
}

bool are_apart(std::span<const Box> boxes) {
  std::vector<std::uint32_t> groups = Divider(boxes, 0, false).run();
  std::sort(groups.begin(), groups.end());
  return std::adjacent_find(groups.begin(), groups.end()) == groups.end();
}

}  // namespace meshrepair::internal
