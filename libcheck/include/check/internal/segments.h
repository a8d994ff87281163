// SPDX-License-Identifier: MIT
// How far apart two segments are, or two lines. Rounded.
#pragma once

#include <mesh/soup.h>

namespace meshrepair::internal {

struct Segment {
  Vec3d from = Vec3d::Zero(), to = Vec3d::Zero();
};

// Of the points of the two segments that are nearest to each other.
[[nodiscard]] Segment shortest_between(const Segment& a, const Segment& b);

// Of the lines through two segments. Not a number where they are parallel.
[[nodiscard]] double distance_of_lines(const Segment& a, const Segment& b);

}  // namespace meshrepair::internal
