// SPDX-License-Identifier: MIT
// Random and degenerate shapes for property tests, all from a seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include <exact/grid.h>
#include <mesh/soup.h>

namespace meshrepair::testing {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // Inclusive bounds.
  std::int32_t integer(std::int32_t low, std::int32_t high) {
    const auto span = static_cast<std::uint64_t>(std::int64_t{high} - low) + 1;
    return static_cast<std::int32_t>(low + static_cast<std::int64_t>(engine_() % span));
  }
  double real(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  bool chance(double probability) { return real(0, 1) < probability; }
  GridPoint grid_point(std::int32_t radius = kGridRadius) {
    return {integer(-radius, radius), integer(-radius, radius), integer(-radius, radius)};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace meshrepair::testing
