// SPDX-License-Identifier: MIT
// A mesh as few characters, for a page of HTML. web/viewer/src/decode.js reads it.
//
// The text is base64 of gzip of numbers without a sign, each as bytes of seven bits, the lowest
// first; the highest bit of a byte says that more follow. A number with a sign is twice itself, or
// twice its amount less one if it is negative. The numbers, one list after the other:
//
//   corners  three a triangle: 0 is the next new point, k the one that came k points before that
//   places   of the points, in the order in which corners have them: all x, all y, all z, each
//            with a sign, less the one before; steps of the grid
//   kinds    one a triangle
//   marks    one a triangle: bit d for Defect d
//   values   one a point, in the same order, where the mesh has any
//
// How many points there are is not said, as the corners tell.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

#include "page/drawn_mesh.h"

namespace meshrepair {

// A cube of so many steps, in which both meshes of a page lie.
struct PageGrid {
  static constexpr int kBits = 18;
  static constexpr std::int32_t kMost = (std::int32_t{1} << kBits) - 1;
  using Steps = std::array<std::int32_t, 3>;

  Vec3d low = Vec3d::Zero();
  double half = 0;  // of its side, as a side may be too large for a double
  Steps high = {};  // of the box of the meshes

  // Pre: finite, and in the box.
  [[nodiscard]] Steps steps_of(const Vec3d& point) const;
};

// Around all triangles that are finite.
[[nodiscard]] PageGrid grid_of(const std::vector<const TriangleSoup*>& soups);

// Of one mesh: how many steps its box has along each axis.
[[nodiscard]] PageGrid::Steps sides_of(const TriangleSoup& soup, const PageGrid& grid);

// Throws Cancelled.
[[nodiscard]] std::string pack_mesh(const DrawnMesh& mesh, const PageGrid& grid,
                                    ProgressObserver* progress);

}  // namespace meshrepair
