// SPDX-License-Identifier: MIT
// Surfaces of soups, for tests.
#pragma once

#include <cstdint>
#include <utility>

#include <extract/surface.h>

namespace meshrepair::testing {

// As if each triangle and each point were one of the input.
inline Surface as_surface(TriangleSoup soup) {
  Surface surface;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) surface.source.push_back(t);
  surface.input_point.assign(soup.points.size(), 1);
  surface.mesh = std::move(soup);
  return surface;
}

}  // namespace meshrepair::testing
