// SPDX-License-Identifier: MIT
// Solids as one soup whose triangles know which of the solids have them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bsp/clean_soup.h>
#include <repair/orient_parts.h>

namespace meshrepair::internal {

// A solid that has a triangle, and how often more that is turned along the normal of its plane than
// against it; not 0.
struct SolidWinding {
  std::uint32_t solid = 0;
  std::int32_t winding = 0;
  bool operator==(const SolidWinding&) const = default;
  auto operator<=>(const SolidWinding&) const = default;  // NOLINT(modernize-use-nullptr)
};

class JoinedSolids {
 public:
  // What the solids are on one grid, and of each the number of triangles that were given, by which
  // sources count on through all of them. `soups` is not empty. n log(solids).
  JoinedSolids(std::vector<CleanSoup> soups, std::span<const std::size_t> given);

  [[nodiscard]] const CleanSoup& soup() const { return soup_; }
  [[nodiscard]] std::size_t solids() const { return first_of_solid_.size() - 1; }
  // In the order of the solids.
  [[nodiscard]] std::span<const SolidWinding> of(TriangleId t) const {
    return {of_triangle_.data() + first_[t.index()], first_[t.index() + 1] - first_[t.index()]};
  }
  // Of one solid, for each triangle; 0 where it has none.
  [[nodiscard]] IdVector<TriangleId, std::int32_t> windings(std::size_t solid) const;
  // Triangles that the same solids have, turned alike, are one part: that is all that graphs of
  // chambers need to know of parts. Windings are those of the first solid.
  [[nodiscard]] Orientation orientation() const;

 private:
  void list_by_triangle();

  // A triangle of one solid.
  struct OfSolid {
    TriangleId triangle;
    std::int32_t winding = 0;
  };

  CleanSoup soup_;
  std::vector<OfSolid> of_solid_;  // by the solids
  std::vector<std::size_t> first_of_solid_;
  std::vector<SolidWinding> of_triangle_;
  std::vector<std::size_t> first_;  // of each triangle, in of_triangle_
};

}  // namespace meshrepair::internal
