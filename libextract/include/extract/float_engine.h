// SPDX-License-Identifier: MIT
// Predicates in floating point with a tolerance (WM 4.2.1), for comparison with the exact ones.
//
// The sign of a plane's rounded distance, 0 within a tolerance. A new point is interpolated along
// its edge, and coordinates are all that is known of it. What comes of the answers that are wrong
// is the clipper's business, which keeps the topology sound.
#pragma once

#include <array>

#include <bsp/clean_soup.h>
#include <extract/predicate_engine.h>

namespace meshrepair {

// The paper's choice, relative to the largest side of the input's bounding box.
inline constexpr double kDefaultEpsilon = 5e-10;

// The point between `a` and `b` whose distance to the plane is 0 if distances change evenly,
// clamped to the edge; the middle where the distances do not differ. Always finite, never beyond
// the ends by more than rounding, with the larger of both tolerances.
[[nodiscard]] Point interpolate(const Point& a, const Point& b, const Plane& plane);

class FloatEngine final : public PredicateEngine {
 public:
  // `tolerance` in grid steps, finite and not negative.
  explicit FloatEngine(double tolerance) : tolerance_(static_cast<float>(tolerance)) {}
  // `epsilon` is relative to the largest side of the input's bounding box.
  FloatEngine(const CleanSoup& soup, double epsilon);

  [[nodiscard]] double tolerance() const override { return tolerance_; }
  int side(const Point& point, PlaneId plane, const PlaneTable& planes) override;
  Point cross(const Point& a, const Point& b, PlaneId p, PlaneId q, PlaneId plane,
              const PlaneTable& planes) override;

 private:
  double tolerance_;  // a float, as points store it, so that both say the same
};

}  // namespace meshrepair
