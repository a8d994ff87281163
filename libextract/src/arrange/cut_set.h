// SPDX-License-Identifier: MIT
// The triangles of a soup that meet others, with their edges and planes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bsp/clean_soup.h>
#include <exact/plane_table.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

// 1 if the corners of a triangle are counter-clockwise as seen from where its plane's normal
// points.
[[nodiscard]] int corner_side(const CleanSoup& soup, std::uint32_t triangle);

// Called cut, and numbered in the order of the soup.
class CutSet {
 public:
  using Pair = std::array<std::uint32_t, 2>;

  // `pairs`: triangles of the soup that meet.
  CutSet(const CleanSoup& soup, std::span<const Pair> pairs);

  [[nodiscard]] const CleanSoup& soup() const { return soup_; }
  [[nodiscard]] std::size_t size() const { return triangles_.size(); }
  // In the soup, ascending.
  [[nodiscard]] std::span<const std::uint32_t> triangles() const { return triangles_; }
  [[nodiscard]] std::uint32_t number_of(std::uint32_t triangle_of_soup) const {
    return number_[triangle_of_soup];  // kNone if it is not cut
  }
  // Points of the soup.
  [[nodiscard]] const IndexTriangle& corners(std::uint32_t cut) const { return corners_[cut]; }
  [[nodiscard]] PlaneId plane(std::uint32_t cut) const { return plane_[cut]; }
  // 1 if the corners are counter-clockwise as seen from where the plane's normal points, else -1.
  [[nodiscard]] int side_of(std::uint32_t cut) const { return side_[cut]; }

  [[nodiscard]] std::size_t edges() const { return ends_.size(); }
  [[nodiscard]] std::uint32_t edge(std::uint32_t cut, std::size_t k) const {
    return edge_of_side_[3 * cut + k];
  }
  // The lower point first.
  [[nodiscard]] const std::array<std::uint32_t, 2>& ends(std::uint32_t edge) const {
    return ends_[edge];
  }
  // That of a triangle at the edge, and one across it, parallel to an axis.
  [[nodiscard]] const std::array<PlaneId, 2>& planes_of(std::uint32_t edge) const {
    return edge_planes_[edge];
  }
  // One that contains the edge and is not that of a triangle in which the edge lies.
  [[nodiscard]] PlaneId plane_across(std::uint32_t edge, PlaneId triangle) const {
    const auto& [beside, across] = edge_planes_[edge];
    return beside == triangle ? across : beside;
  }
  [[nodiscard]] const PlaneTable& planes() const { return planes_; }

 private:
  void list_planes();
  void list_edges();

  const CleanSoup& soup_;
  std::vector<std::uint32_t> number_;
  std::vector<std::uint32_t> triangles_;
  std::vector<IndexTriangle> corners_;
  std::vector<PlaneId> plane_;
  std::vector<std::int8_t> side_;
  std::vector<std::uint32_t> edge_of_side_;
  std::vector<std::array<std::uint32_t, 2>> ends_;
  std::vector<std::array<PlaneId, 2>> edge_planes_;
  PlaneTable planes_;
};

}  // namespace meshrepair::internal
