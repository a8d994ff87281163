// SPDX-License-Identifier: MIT
// A region is a height field where, seen along a coordinate axis, its triangles lie side by side.
// That follows from its outline. Let all triangles turn the same way as seen along the axis, be
// connected through edges of two, and let the outline, the sides without neighbour, be simple with
// the outside beyond it. How many triangles cover a point is how often the outline winds around it:
// once inside, never outside. So no two triangles overlap. They could still touch, but where the
// side of one is not in the outline, triangles cover all around it, and so they do at a corner not
// in the outline, and what touches there would overlap one of them; and outline edges meet at
// shared corners alone.
//
// As Volino and Magnenat-Thalmann, Efficient self-collision detection on smoothly discretized
// surface animations using geometrical shape regularity (1994), who take it for cloth.
//
// A region with another outline is cut in pieces that follow each other in the tree of boxes, again
// and again.
#include "height_fields.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include <base/ids.h>
#include <base/parallel.h>
#include <exact/double_predicates.h>
#include <mesh/edge_table.h>

#include "simple_outline.h"

namespace meshrepair::internal {
namespace {

// Comparing fewer is as fast.
constexpr std::size_t kFewest = 8;
constexpr std::size_t kMostPieces = 8;
constexpr std::size_t kFacingsPerTask = 8192;

// Of so many triangles, at most so many whose boxes meet theirs are looked at; in large regions so
// many of ten face the same way.
constexpr std::size_t kSamples = 128, kMostNeighbours = 32, kAlike = 8;

// The axis along which a triangle is seen, from 1, with the sign of its turn.
std::int16_t facing_of(const CornerTriangle& t) {
  const int turn = orientation_along(t.axis, t.at[0], t.at[1], t.at[2]);
  return static_cast<std::int16_t>(turn * (t.axis + 1));
}

class HeightFields {
 public:
  explicit HeightFields(const TriangleList& list)
      : corners_(list.corners()), list_(list), region_(list.size(), kNone), part_(list.size()) {
    find_facing();
    find_neighbours();
  }

  std::vector<std::uint32_t> run(const BoxTree& tree) {
    std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
    const std::vector<std::size_t> first = divide(order, kNone);
    parallel_for(first.size() - 1, [&](std::size_t r) {
      settle(std::span(order).subspan(first[r], first[r + 1] - first[r]));
    });
    return std::move(region_);
  }

 private:
  [[nodiscard]] const IndexTriangle& points_of(std::uint32_t t) const {
    return corners_.soup().triangles[list_.ids()[t]];
  }
  [[nodiscard]] const Vec3d& point(std::uint32_t p) const { return corners_.soup().points[p]; }

  void find_facing() {
    facing_.resize(list_.size());
    parallel_tasks(list_.size(), kFacingsPerTask,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t t = first; t < last; ++t) {
                       facing_[t] = facing_of(list_.triangle(static_cast<std::uint32_t>(t)));
                     }
                   });
  }

  // Across each side, through edges of two triangles.
  void find_neighbours() {
    across_.assign(3 * list_.size(), kNone);
    std::vector<IndexTriangle> triangles(list_.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) triangles[t][k] = corners_.corner(points_of(t)[k]);
    }
    EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() != 2) return;
      const std::uint32_t s = sides[0] / 3, t = sides[1] / 3;
      if (facing_[s] != facing_[t]) return;
      if (side_start(triangles, sides[0]) == side_start(triangles, sides[1])) return;
      across_[sides[0]] = t;
      across_[sides[1]] = s;
    });
  }

  // Sorts triangles, all those in `region`, by what of them is connected, otherwise in the order in
  // which they are, and says where each part begins, and where the last one ends. Each part becomes
  // a region of its own, named by its first triangle.
  std::vector<std::size_t> divide(std::span<std::uint32_t> triangles, std::uint32_t region) {
    std::vector<std::size_t> first(1, 0);
    std::vector<std::uint32_t> waiting;
    for (const std::uint32_t seed : triangles) {
      if (region_[seed] != region) continue;
      part_[seed] = static_cast<std::uint32_t>(first.size() - 1);
      std::size_t size = 0;
      region_[seed] = seed;
      waiting.push_back(seed);
      while (!waiting.empty()) {
        const std::uint32_t t = waiting.back();
        waiting.pop_back();
        ++size;
        for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
          const std::uint32_t other = across_[side];
          if (other == kNone || region_[other] != region) continue;
          region_[other] = seed;
          waiting.push_back(other);
        }
      }
      first.push_back(first.back() + size);
    }
    std::vector<std::size_t> place(first.begin(), first.end() - 1);
    std::vector<std::uint32_t> sorted(triangles.size());
    for (const std::uint32_t t : triangles) sorted[place[part_[region_[t]]]++] = t;
    std::copy(sorted.begin(), sorted.end(), triangles.begin());
    return first;
  }

  void settle(std::span<std::uint32_t> triangles) {
    if (triangles.size() < kFewest) {
      for (const std::uint32_t t : triangles) region_[t] = kNone;
      return;
    }
    if (has_simple_outline(triangles)) return;
    const std::size_t pieces = std::clamp(triangles.size() / kFewest, std::size_t{2}, kMostPieces);
    const auto piece = [&](std::size_t i) {
      const std::size_t first = i * triangles.size() / pieces;
      return triangles.subspan(first, (i + 1) * triangles.size() / pieces - first);
    };
    // Each piece by its last triangle, which names no region but one of its own alone.
    for (std::size_t i = 0; i < pieces; ++i) {
      for (const std::uint32_t t : piece(i)) region_[t] = piece(i).back();
    }
    for (std::size_t i = 0; i < pieces; ++i) {
      const std::vector<std::size_t> first = divide(piece(i), piece(i).back());
      for (std::size_t r = 0; r + 1 < first.size(); ++r) {
        settle(piece(i).subspan(first[r], first[r + 1] - first[r]));
      }
    }
  }

  [[nodiscard]] bool has_simple_outline(std::span<const std::uint32_t> triangles) const {
    std::vector<OutlineEdge> outline;
    for (const std::uint32_t t : triangles) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t other = across_[3 * t + k];
        if (other != kNone && region_[other] == region_[t]) continue;
        const std::uint32_t from = points_of(t)[k], to = points_of(t)[k == 2 ? 0 : k + 1];
        outline.push_back({corners_.corner(from), corners_.corner(to), &point(from), &point(to)});
      }
    }
    const int facing = facing_[triangles.front()];
    return is_simple_outline(outline, std::abs(facing) - 1, facing > 0 ? 1 : -1);
  }

  const SoupCorners& corners_;
  const TriangleList& list_;
  std::vector<std::int16_t> facing_;   // see facing_of()
  std::vector<std::uint32_t> across_;  // of each side the neighbour that faces the same way
  std::vector<std::uint32_t> region_;
  std::vector<std::uint32_t> part_;  // scratch
};

}  // namespace

bool may_have_height_fields(const TriangleList& triangles, const BoxTree& tree) {
  if (triangles.size() < kFewest * kSamples) return false;
  const std::span<const Box> boxes = triangles.boxes();
  std::size_t neighbours = 0, alike = 0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const auto sample = static_cast<std::uint32_t>(k * triangles.size() / kSamples);
    const std::int16_t facing = facing_of(triangles.triangle(sample));
    std::size_t seen = 0;
    tree.visit([&](const Box& box) { return seen < kMostNeighbours && box.meets(boxes[sample]); },
               [&](std::uint32_t other) {
                 if (other == sample || !boxes[other].meets(boxes[sample])) return;
                 ++seen;
                 alike += facing_of(triangles.triangle(other)) == facing ? 1 : 0;
               });
    neighbours += seen;
  }
  return 10 * alike >= kAlike * neighbours;
}

std::vector<std::uint32_t> find_height_fields(const TriangleList& triangles, const BoxTree& tree) {
  return HeightFields(triangles).run(tree);
}

}  // namespace meshrepair::internal
