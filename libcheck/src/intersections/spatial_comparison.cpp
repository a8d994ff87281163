// SPDX-License-Identifier: MIT
// Long thin triangles, as those between the tip of a cone and its rim, have boxes that meet nearly
// all others. So space is cut in halves instead, along one of the triangles where they lie askew,
// and each half gets the parts of triangles in it, with boxes of these parts alone, until few
// triangles are left, or only such as have a hub in common. The boxes are what rounding leaves of
// them and a margin that is far larger than its errors; a pair is decided exactly. It may be met in
// several places: what is found is found once.
#include "spatial_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include <base/assert.h>
#include <base/error.h>

#include "clipped_triangle.h"
#include "dividing_wall.h"
#include "triangle_hubs.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kSamples = 256;
constexpr std::size_t kTestsPerSample = 32;
// On a common mesh it is about 15.
constexpr std::size_t kManyNeighbours = 256;
constexpr std::size_t kHitsAreRare = 16;

// Up to here all pairs are tested.
constexpr std::size_t kFew = 16;
// Cuts in a row that took few triangles away: what is left lies together in one place.
constexpr int kMostVainCuts = 9;
// How many triangles offer walls, and on how many each wall is judged.
constexpr std::size_t kOffered = 12;
constexpr std::size_t kJudges = 48;
constexpr std::size_t kCellsPerQuestion = 256;
// For each triangle: about 70 clipped parts are enough to tell the sides of a cone of 100,000
// apart, while thin triangles that pass each other closely, askew to the axes, fall into ever more.
constexpr std::size_t kMostWork = 256;

bool have_one_hub(std::span<const std::uint32_t> hubs, std::uint32_t a, std::uint32_t b) {
  return !hubs.empty() && hubs[a] != kNoHub && hubs[a] == hubs[b];
}

class SpatialComparison {
 public:
  SpatialComparison(std::span<const CornerTriangle> triangles, std::span<const std::uint32_t> hubs,
                    ProgressObserver* progress)
      : triangles_(triangles), hubs_(hubs), progress_(progress) {
    double largest = 0;
    for (const CornerTriangle& t : triangles) {
      for (const Vec3d& p : t.at) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
    int exponent = 0;
    (void)std::frexp(largest, &exponent);
    scaled_.reserve(triangles.size());
    for (const CornerTriangle& t : triangles) {
      std::array<Vec3d, 3> corners = t.at;
      for (Vec3d& p : corners) {
        for (double& x : p) x = std::ldexp(x, -exponent);
      }
      scaled_.push_back(corners);
    }
  }

  std::optional<std::vector<MeetingPair>> run() {
    std::vector<Part> parts;
    parts.reserve(scaled_.size());
    for (std::uint32_t i = 0; i < scaled_.size(); ++i) {
      Box box;
      for (const Vec3d& p : scaled_[i]) box.add(p);
      box.widen(kClipMargin);
      parts.push_back({i, box});
    }
    cells_.push_back({std::move(parts), 0});
    while (!cells_.empty()) {
      const Cell cell = std::move(cells_.back());
      cells_.pop_back();
      ask();
      look_at(cell);
      if (is_too_much()) return std::nullopt;
    }
    keep_once();
    return std::move(found_);
  }

 private:
  struct Part {
    std::uint32_t triangle;
    Box box;  // of what of it is in the cell
  };
  struct Cell {
    std::vector<Part> parts;
    int vain_cuts;
  };

  [[nodiscard]] bool is_too_much() const { return work_ > kMostWork * scaled_.size(); }

  void ask() {
    if (++steps_ % kCellsPerQuestion != 0 || progress_ == nullptr) return;
    if (progress_->cancelled()) throw Cancelled();
  }

  void look_at(const Cell& cell) {
    if (cell.parts.size() < 2 || all_have_one_hub(cell.parts)) return;
    if (cell.parts.size() <= kFew || cell.vain_cuts >= kMostVainCuts) {
      // Many in one place count before they are compared, so that too many never are.
      if (cell.parts.size() > kFew) work_ += cell.parts.size() * cell.parts.size() / 2;
      if (!is_too_much()) compare_all(cell.parts);
    } else {
      halve(cell);
    }
  }

  [[nodiscard]] bool all_have_one_hub(const std::vector<Part>& parts) const {
    return std::all_of(parts.begin() + 1, parts.end(), [&](const Part& part) {
      return have_one_hub(hubs_, parts[0].triangle, part.triangle);
    });
  }

  // In the middle of its longest side; where most triangles are on both sides of that, along one of
  // them.
  void halve(const Cell& cell) {
    Box whole;
    for (const Part& part : cell.parts) whole.add(part.box);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (whole.high[k] - whole.low[k] > whole.high[axis] - whole.low[axis]) axis = k;
    }
    Wall wall{Vec3d::Zero(), 0.5 * (whole.low[axis] + whole.high[axis])};
    wall.normal[static_cast<Eigen::Index>(axis)] = 1;
    const auto on_both_sides = static_cast<std::size_t>(
        std::count_if(cell.parts.begin(), cell.parts.end(), [&](const Part& part) {
          return part.box.low[axis] < wall.offset && part.box.high[axis] > wall.offset;
        }));
    if (2 * on_both_sides > cell.parts.size()) wall = wall_along_a_triangle(cell).value_or(wall);
    add_half(cell, wall);
    add_half(cell, {-wall.normal, -wall.offset});
  }

  std::optional<Wall> wall_along_a_triangle(const Cell& cell) {
    offered_.clear();
    judges_.clear();
    const std::size_t offered = std::min(kOffered, cell.parts.size());
    for (std::size_t i = 0; i < offered; ++i) {
      offered_.push_back(scaled_[cell.parts[i * cell.parts.size() / offered].triangle]);
    }
    const std::size_t judges = std::min(kJudges, cell.parts.size());
    for (std::size_t i = 0; i < judges; ++i) {
      const Part& part = cell.parts[i * cell.parts.size() / judges];
      judges_.emplace_back(scaled_[part.triangle], part.box);
    }
    work_ += kOffered;
    return choose_wall(offered_, judges_);
  }

  // The parts of what is above the wall.
  void add_half(const Cell& cell, const Wall& wall) {
    std::vector<Part> parts;
    for (const Part& part : cell.parts) {
      if (highest(part.box, wall) < -kClipMargin) continue;
      ++work_;
      ClippedTriangle clipped(scaled_[part.triangle], part.box);
      clipped.clip(wall);
      if (!clipped.empty()) parts.push_back({part.triangle, clipped.box()});
    }
    const bool in_vain = 8 * parts.size() > 7 * cell.parts.size();
    cells_.push_back({std::move(parts), in_vain ? cell.vain_cuts + 1 : 0});
  }

  static double highest(const Box& box, const Wall& wall) {
    Vec3d corner;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      corner[k] = wall.normal[k] < 0 ? box.low[axis] : box.high[axis];
    }
    return wall.height(corner);
  }

  void compare_all(const std::vector<Part>& parts) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      ask();
      for (std::size_t j = i + 1; j < parts.size(); ++j) {
        if (!parts[i].box.meets(parts[j].box)) continue;
        const auto [a, b] = std::minmax(parts[i].triangle, parts[j].triangle);
        if (have_one_hub(hubs_, a, b)) continue;
        const Meeting meeting = meeting_of(triangles_[a], triangles_[b]);
        if (meeting != Meeting::apart) add({a, b, meeting});
      }
    }
  }

  void add(const MeetingPair& pair) {
    found_.push_back(pair);
    if (found_.size() >= 2 * once_ + 4096) keep_once();
  }

  void keep_once() {
    const auto key = [](const MeetingPair& pair) { return std::tie(pair.a, pair.b); };
    std::sort(found_.begin(), found_.end(),
              [&](const MeetingPair& x, const MeetingPair& y) { return key(x) < key(y); });
    found_.erase(
        std::unique(found_.begin(), found_.end(),
                    [&](const MeetingPair& x, const MeetingPair& y) { return key(x) == key(y); }),
        found_.end());
    once_ = found_.size();
  }

  std::span<const CornerTriangle> triangles_;
  std::span<const std::uint32_t> hubs_;
  ProgressObserver* progress_;
  std::vector<std::array<Vec3d, 3>> scaled_;
  std::vector<std::array<Vec3d, 3>> offered_;  // scratch
  std::vector<ClippedTriangle> judges_;        // scratch
  std::vector<Cell> cells_;
  std::vector<MeetingPair> found_;
  std::size_t once_ = 0;  // how many of them are known to be there once
  std::size_t steps_ = 0;
  std::size_t work_ = 0;  // parts clipped, and pairs tested
};

}  // namespace

bool boxes_tell_little(const TriangleList& triangles, std::span<const std::uint32_t> hubs,
                       const BoxTree& tree) {
  const std::span<const Box> boxes = triangles.boxes();
  if (triangles.size() < kSamples * kManyNeighbours / 16) return false;
  std::size_t neighbours = 0, tests = 0, hits = 0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const auto sample = static_cast<std::uint32_t>(k * triangles.size() / kSamples);
    const CornerTriangle triangle = triangles.triangle(sample);
    std::size_t own_tests = 0;
    tree.visit([&](const Box& box) { return box.meets(boxes[sample]); },
               [&](std::uint32_t other) {
                 if (other == sample || !boxes[other].meets(boxes[sample])) return;
                 if (have_one_hub(hubs, sample, other)) return;
                 ++neighbours;
                 if (++own_tests > kTestsPerSample) return;
                 ++tests;
                 hits += meeting_of(triangle, triangles.triangle(other)) != Meeting::apart;
               });
  }
  return neighbours > kSamples * kManyNeighbours && hits * kHitsAreRare < tests;
}

std::optional<std::vector<MeetingPair>> compare_in_space(const TriangleList& list,
                                                         std::span<const std::uint32_t> hubs,
                                                         ProgressObserver* progress) {
  std::vector<CornerTriangle> triangles;
  triangles.reserve(list.size());
  for (std::uint32_t i = 0; i < list.size(); ++i) triangles.push_back(list.triangle(i));
  return SpatialComparison(triangles, hubs, progress).run();
}

}  // namespace meshrepair::internal
