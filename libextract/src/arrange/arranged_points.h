// SPDX-License-Identifier: MIT
// The points in which triangles meet, each once.
//
// A point is named by what it lies on: a corner of the input, an edge and the inside of a triangle,
// two edges, or the insides of three triangles. One place may have several names, where an edge
// passes the line in which two triangles meet, say. All names of a place come to stand next to each
// other when the points of an edge, or of a segment in which two triangles meet, are put into
// order; that is where they are joined.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <base/disjoint_sets.h>
#include <exact/point.h>

#include "cut_set.h"

namespace meshrepair::internal {

// The name of a point that is a corner, or on an edge at least.
class PointName {
 public:
  PointName() = default;
  static PointName corner(std::uint32_t point) { return PointName(point); }
  static PointName edge_and_triangle(std::uint32_t edge, std::uint32_t cut) {
    return PointName(std::uint64_t{1} << 62 | std::uint64_t{edge} << 32 | cut);
  }
  static PointName two_edges(std::uint32_t a, std::uint32_t b) {
    return PointName(std::uint64_t{2} << 62 | std::uint64_t{a < b ? a : b} << 32 | (a < b ? b : a));
  }

  [[nodiscard]] bool is_corner() const { return value_ >> 62 == 0; }
  [[nodiscard]] bool is_on_triangle() const { return value_ >> 62 == 1; }
  // The point, if it is a corner; else the edge, or the lower one.
  [[nodiscard]] std::uint32_t point() const { return static_cast<std::uint32_t>(value_); }
  [[nodiscard]] std::uint32_t edge() const {
    return static_cast<std::uint32_t>(value_ >> 32) & 0x3fffffffu;
  }
  // The triangle, or the other edge.
  [[nodiscard]] std::uint32_t other() const { return static_cast<std::uint32_t>(value_); }
  auto operator<=>(const PointName&) const = default;  // NOLINT(modernize-use-nullptr)

  static constexpr std::size_t kMostEdges = std::size_t{1} << 30;

 private:
  explicit PointName(std::uint64_t value) : value_(value) {}
  std::uint64_t value_ = 0;
};

// The insides of three triangles, ascending.
using TripleName = std::array<std::uint32_t, 3>;

// The soup's points have their own numbers, the new ones those after these.
class ArrangedPoints {
 public:
  // `names` may repeat.
  ArrangedPoints(const CutSet& cut, std::vector<PointName> names);

  void add_triples(std::vector<TripleName> names);

  // kNone if there is no such point.
  [[nodiscard]] std::uint32_t find(const PointName& name) const;
  [[nodiscard]] std::uint32_t find(const TripleName& name) const;
  // Whether all of them could be found in their planes.
  [[nodiscard]] bool sound() const;
  [[nodiscard]] std::size_t size() const { return first_new_ + points_.size(); }
  [[nodiscard]] std::size_t first_new() const { return first_new_; }
  [[nodiscard]] Point at(std::uint32_t point) const;

  void join(std::uint32_t a, std::uint32_t b) { same_.join(a, b); }
  // To be called when all are joined.
  void settle();
  // The one that stands for all with its place, which is the soup's if one of these is.
  [[nodiscard]] std::uint32_t settled(std::uint32_t point) const {
    return settled_.empty() || point < first_new_ ? point : settled_[point - first_new_];
  }

 private:
  [[nodiscard]] Point meet_of(const PointName& name) const;

  const CutSet& cut_;
  std::size_t first_new_;
  std::vector<PointName> names_;
  std::vector<TripleName> triples_;
  std::vector<Point> points_;
  DisjointSets same_;
  std::vector<std::uint32_t> settled_;
};

// A line by a point's direction in it.
using Direction = std::array<Int128, 3>;

// Whether q lies behind p (1), before it (-1) or at it (0), on a line with that direction on which
// both lie, exactly.
[[nodiscard]] int order_along(const Direction& direction, const Point& p, const Point& q,
                              const PlaneTable& planes);

// Of the line of two planes that are not parallel.
[[nodiscard]] Direction direction_of(const Plane& a, const Plane& b);

}  // namespace meshrepair::internal
