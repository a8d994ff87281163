// SPDX-License-Identifier: MIT
// An engine whose answers are worth nothing, for tests of what has to hold all the same.
#pragma once

#include <array>
#include <cstdint>

#include <extract/predicate_engine.h>

#include "random_geometry.h"

namespace meshrepair::testing {

// Answers at random, as often as `wrong` says, and makes points anywhere on an edge.
class UnreliableEngine final : public PredicateEngine {
 public:
  UnreliableEngine(std::uint64_t seed, double wrong) : random_(seed), wrong_(wrong) {}
  int side(const Point& point, PlaneId plane, const PlaneTable& planes) override {
    if (random_.chance(wrong_)) return random_.integer(-1, 1);
    return meshrepair::side(point, plane, planes);
  }
  Point cross(const Point& a, const Point& b, PlaneId, PlaneId, PlaneId,
              const PlaneTable&) override {
    const double t = random_.real(0, 1);
    std::array<double, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = (1 - t) * a.position[i] + t * b.position[i];
    return loose_point(at);
  }

 private:
  Random random_;
  double wrong_;
};

}  // namespace meshrepair::testing
