// SPDX-License-Identifier: MIT
// How do two triangles meet? Exactly.
#pragma once

#include <array>
#include <cstdint>

#include <mesh/soup.h>

namespace meshrepair::internal {

// Not degenerate.
struct CornerTriangle {
  std::array<Vec3d, 3> at;
  std::array<std::uint32_t, 3> corner{};  // equal numbers are shared corners, and have equal places
  int axis = 0;  // along which its projection has an area (projection_axis)
};

enum class Meeting {
  apart,     // nothing in common beyond the corners and the edge that they share
  crossing,  // each has points on both sides of the other's plane
  touching,  // not crossing, in different planes
  coplanar,  // in the same plane; equal triangles too
};

// Symmetric.
[[nodiscard]] Meeting meeting_of(const CornerTriangle& a, const CornerTriangle& b);

// Whether all corners of one are within this distance of the other's plane, and the two overlap as
// seen along an axis, not only at their sides. The distances are rounded. Symmetric.
[[nodiscard]] bool nearly_overlap(const CornerTriangle& a, const CornerTriangle& b,
                                  double distance);

}  // namespace meshrepair::internal
