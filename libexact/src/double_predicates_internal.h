// SPDX-License-Identifier: MIT
// The exact stages of the predicates on doubles, one by one, for the predicates and their own test.
#pragma once

#include <optional>

#include <base/vec3.h>

namespace meshrepair::internal {

// By 64-bit differences and 256-bit products. Nothing where the differences of coordinates are no
// multiples of 2^-61 of the largest of them: rare, as the points of one mesh are near each other.
[[nodiscard]] std::optional<int> short_orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                                   const Vec3d& d);
[[nodiscard]] std::optional<int> short_orientation_along(int axis, const Vec3d& a, const Vec3d& b,
                                                         const Vec3d& c);

// By numbers of two doubles. 0 where these can't tell: hardly ever but for points in one plane.
[[nodiscard]] int filtered_long_orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                            const Vec3d& d);

// By integers of any length: always right, and slow where the magnitudes differ much.
[[nodiscard]] int long_orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);
[[nodiscard]] int long_orientation_along(int axis, const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace meshrepair::internal
