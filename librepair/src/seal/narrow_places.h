// SPDX-License-Identifier: MIT
// Where triangles that face each other are near each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

class NarrowPlaces {
 public:
  // Bricks have sides of `side`, the first of them its lowest corner at `low`. Narrow is a place
  // with two triangles around it that face each other and are up to `width` apart. The soup is the
  // boundary of a solid, and outlives this.
  NarrowPlaces(const TriangleSoup& soup, const Vec3d& low, double side, double width,
               ProgressObserver* progress);

  // All bricks with narrow places, of so many bricks along each axis. Nothing if there are more.
  [[nodiscard]] std::optional<std::vector<std::array<std::int32_t, 3>>> find(
      const std::array<std::int32_t, 3>& size, std::size_t most) const;

 private:
  using Brick = std::array<std::int32_t, 3>;
  using Triangles = std::vector<std::uint32_t>;
  struct Search;

  [[nodiscard]] Triangles near(const Triangles& among, const Brick& low, std::int32_t side) const;
  [[nodiscard]] bool may_face(const Triangles& triangles, std::size_t most_paired) const;
  [[nodiscard]] bool face_each_other(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool is_before(std::uint32_t a, std::uint32_t b) const;
  void descend(const Triangles& among, const Brick& low, std::int32_t side, Search& search) const;

  const TriangleSoup& soup_;
  Vec3d low_;
  double side_, width_;
  ProgressObserver* progress_;
  std::vector<Vec3d> normals_;  // of length 1
};

}  // namespace meshrepair::internal
