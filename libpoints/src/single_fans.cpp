// SPDX-License-Identifier: MIT
#include "single_fans.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "point_blocks.h"

namespace meshrepair {
namespace {

// The triangles at each point.
class Incidence {
 public:
  Incidence(const std::vector<VotedTriangle>& triangles, std::size_t points)
      : first_(points + 1, 0), triangle_(3 * triangles.size()) {
    for (const VotedTriangle& t : triangles) {
      for (const std::uint32_t p : t.corners) ++first_[p + 1];
    }
    for (std::size_t p = 0; p < points; ++p) first_[p + 1] += first_[p];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (const std::uint32_t p : triangles[t].corners) triangle_[next[p]++] = t;
    }
  }

  [[nodiscard]] std::span<const std::uint32_t> at(std::size_t point) const {
    return {triangle_.data() + first_[point], first_[point + 1] - first_[point]};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> triangle_;
};

bool share_edge_at(std::uint32_t point, const VotedTriangle& a, const VotedTriangle& b) {
  for (const std::uint32_t p : a.corners) {
    if (p != point && std::find(b.corners.begin(), b.corners.end(), p) != b.corners.end()) {
      return true;
    }
  }
  return false;
}

// The fan that each of a point's triangles belongs to, named by its first triangle's position.
class Fans {
 public:
  void find(std::uint32_t point, const std::vector<VotedTriangle>& triangles,
            std::span<const std::uint32_t> around) {
    fan_.assign(around.size(), kUnknown);
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (fan_[i] != kUnknown) continue;
      fan_[i] = i;
      waiting_.assign(1, i);
      while (!waiting_.empty()) {
        const std::size_t from = waiting_.back();
        waiting_.pop_back();
        for (std::size_t j = i + 1; j < around.size(); ++j) {
          if (fan_[j] != kUnknown ||
              !share_edge_at(point, triangles[around[from]], triangles[around[j]])) {
            continue;
          }
          fan_[j] = i;
          waiting_.push_back(j);
        }
      }
    }
  }

  // The first of those with the most triangles.
  [[nodiscard]] std::size_t largest() const {
    std::size_t best = 0;
    std::ptrdiff_t most = 0;
    for (std::size_t i = 0; i < fan_.size(); ++i) {
      if (fan_[i] != i) continue;
      const auto size = std::count(fan_.begin(), fan_.end(), i);
      if (size > most) {
        best = i;
        most = size;
      }
    }
    return best;
  }

  [[nodiscard]] const std::vector<std::size_t>& fan() const { return fan_; }

 private:
  static constexpr std::size_t kUnknown = static_cast<std::size_t>(-1);

  std::vector<std::size_t> fan_;
  std::vector<std::size_t> waiting_;
};

std::size_t drop_smaller_fans(std::vector<VotedTriangle>& triangles, std::size_t points) {
  const Incidence incidence(triangles, points);
  const auto beside_largest = [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> found;
    Fans fans;
    for (std::size_t p = first; p < last; ++p) {
      const auto around = incidence.at(p);
      fans.find(static_cast<std::uint32_t>(p), triangles, around);
      const std::size_t kept = fans.largest();
      for (std::size_t i = 0; i < around.size(); ++i) {
        if (fans.fan()[i] != kept) found.push_back(around[i]);
      }
    }
    return found;
  };
  std::vector<char> dropped(triangles.size(), 0);
  parallel_reduce(points, kPointsInBlock, beside_largest,
                  [&](std::vector<std::uint32_t>&, const std::vector<std::uint32_t>& found) {
                    for (const std::uint32_t t : found) dropped[t] = 1;
                  });
  std::size_t left = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (dropped[t] == 0) triangles[left++] = triangles[t];
  }
  const std::size_t count = triangles.size() - left;
  triangles.resize(left);
  return count;
}

}  // namespace

std::size_t keep_single_fans(std::vector<VotedTriangle>& triangles, std::size_t points) {
  std::size_t all = 0;
  for (std::size_t dropped = 1; dropped > 0; all += dropped) {
    dropped = drop_smaller_fans(triangles, points);
  }
  return all;
}

}  // namespace meshrepair
