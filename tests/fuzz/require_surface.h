// SPDX-License-Identifier: MIT
// Demands on the surfaces that come out, held against check_surface().
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <check/check_surface.h>

#include "fuzz_input.h"

namespace meshrepair::testing {

inline void require_closed_manifold(const SurfaceCheck& check) {
  require(check.closed(), "the surface is not closed");
  require(check.manifold(), "the surface is not manifold");
  require(check.oriented(), "the surface is not oriented");
}

// "2 self_intersections 1 inside_out_parts"
inline std::string defects_of(const SurfaceCheck& check) {
  std::string all;
  for (std::size_t d = 0; d < kDefects; ++d) {
    const auto defect = static_cast<Defect>(d);
    if (check[defect].count == 0) continue;
    all += " " + std::to_string(check[defect].count) + " " + std::string(defect_name(defect));
  }
  return all;
}

inline void require_valid_solid(const SurfaceCheck& check) {
  require(check.valid_solid(), "what is certified has" + defects_of(check));
}

}  // namespace meshrepair::testing
