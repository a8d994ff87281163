// The triangles that the points of a cloud want, each for itself.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <points/point_soup.h>

#include "sift_points.h"
#include "tangent_plane.h"

namespace meshrepair {

struct StarTriangle {
  std::array<std::uint32_t, 3> corners;  // ascending
  // 1: (corners[0], corners[1], corners[2]) is counter-clockwise seen from where the point's normal
  // points to, -1: clockwise, 0: the point does not know which side is out.
  std::int8_t turn = 0;
};

// The tangent planes, given or fitted. Throws Cancelled.
[[nodiscard]] std::vector<TangentPlane> find_tangent_planes(const SiftedCloud& cloud,
                                                            const PointSoupOptions& options);

// The triangles of all stars, those that several points want as often. Throws Cancelled.
[[nodiscard]] std::vector<StarTriangle> build_stars(const SiftedCloud& cloud,
                                                    const std::vector<TangentPlane>& planes,
                                                    const PointSoupOptions& options);

}  // namespace meshrepair
