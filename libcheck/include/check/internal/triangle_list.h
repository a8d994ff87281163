// SPDX-License-Identifier: MIT
// The triangles of a soup that have an area, with what comparing them needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <base/raw_vector.h>
#include <base/release.h>
#include <check/box_tree.h>
#include <check/internal/triangle_pair.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

[[nodiscard]] Box box_of(const TriangleSoup& soup, std::uint32_t triangle);

enum class Fetched { usable, degenerate, not_finite };

// Which corners of a soup count as one: those of one index or, welded, those of equal coordinates.
class SoupCorners {
 public:
  SoupCorners(const TriangleSoup& soup, bool weld);
  // `corners` has that of each point, all of them below `end`.
  SoupCorners(const TriangleSoup& soup, std::vector<std::uint32_t> corners, std::size_t end)
      : soup_(soup), welded_(std::move(corners)), end_(end) {}

  [[nodiscard]] const TriangleSoup& soup() const { return soup_; }
  [[nodiscard]] std::uint32_t corner(std::uint32_t point) const {
    return welded_.empty() ? point : welded_[point];
  }
  // Behind the highest one that there may be.
  [[nodiscard]] std::size_t end() const { return end_; }
  // Only if it is usable, `fetched` is one.
  [[nodiscard]] Fetched fetch(std::uint32_t triangle, CornerTriangle& fetched) const;

 private:
  const TriangleSoup& soup_;
  std::vector<std::uint32_t> welded_;  // empty: by index
  std::size_t end_;
};

// Which triangles these are, and their boxes. Made on several threads. `corners` has to stay.
class TriangleList {
 public:
  explicit TriangleList(const SoupCorners& corners);
  explicit TriangleList(SoupCorners&& corners) = delete;
  // Each of `among` once, in that order.
  TriangleList(const SoupCorners& corners, std::span<const std::uint32_t> among);
  TriangleList(SoupCorners&& corners, std::span<const std::uint32_t> among) = delete;

  [[nodiscard]] std::size_t size() const { return ids_.size(); }
  [[nodiscard]] const SoupCorners& corners() const { return corners_; }
  [[nodiscard]] CornerTriangle triangle(std::uint32_t i) const;
  [[nodiscard]] std::span<const Box> boxes() const { return boxes_; }
  // Their numbers in the soup.
  [[nodiscard]] std::span<const std::uint32_t> ids() const { return ids_; }
  void drop_boxes() { release(boxes_); }
  [[nodiscard]] std::size_t degenerate() const { return degenerate_; }
  [[nodiscard]] std::size_t not_finite() const { return not_finite_; }

 private:
  template <class IdOf>
  void add(std::size_t count, const IdOf& id_of);

  const SoupCorners& corners_;
  RawVector<Box> boxes_;
  RawVector<std::uint32_t> ids_;
  std::size_t degenerate_ = 0;
  std::size_t not_finite_ = 0;
};

}  // namespace meshrepair::internal
