// SPDX-License-Identifier: MIT
// Grid points as keys of a HashIndex.
#pragma once

#include <cstdint>

#include <base/internal/hash_index.h>
#include <exact/grid.h>

namespace meshrepair::internal {

inline std::uint64_t hash_of(const GridPoint& p) {
  std::uint64_t h = hash_mix(0, static_cast<std::uint64_t>(p.x));
  h = hash_mix(h, static_cast<std::uint64_t>(p.y));
  return hash_mix(h, static_cast<std::uint64_t>(p.z));
}

}  // namespace meshrepair::internal
