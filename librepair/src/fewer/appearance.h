// SPDX-License-Identifier: MIT
// What is seen on a repaired surface, as numbers that decimation can weigh against its shape.
#pragma once

#include <cstddef>
#include <vector>

#include <extract/surface.h>
#include <mesh/attributes.h>

namespace meshrepair::internal {

struct Appearance {
  std::size_t of_corner = 0;
  std::vector<double> values;  // so many of each corner, in the surface's units
};

// DecimationOptions::values, of textures and colours that no corner lacks: places in a picture as
// long as they are on the surface, on the average, times a weight; colours as shares of the
// surface's diagonal. `carried` are the attributes of the surface.
[[nodiscard]] Appearance appearance_of(const Surface& surface, const Attributes& carried);

}  // namespace meshrepair::internal
