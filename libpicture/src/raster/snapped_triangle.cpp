// SPDX-License-Identifier: MIT
#include "raster/snapped_triangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace meshrepair {
namespace {

// Steps: products of two differences of coordinates, and sums of three of them, fit in 64 bits.
constexpr double kFarthest = 1 << 28;

constexpr std::int64_t kMiddle = kStepsOfSample / 2;  // of a sample

std::int64_t floor_of(std::int64_t a, std::int64_t positive) {
  const std::int64_t quotient = a / positive;
  return quotient - (a % positive < 0 ? 1 : 0);
}

std::int64_t ceiling_of(std::int64_t a, std::int64_t positive) { return -floor_of(-a, positive); }

// The first sample whose middle is not before this place.
std::int64_t first_from(std::int64_t steps) { return ceiling_of(steps - kMiddle, kStepsOfSample); }

}  // namespace

SnappedPoint snapped(const Camera::Place& place, unsigned samples) {
  const double per_pixel = static_cast<double>(kStepsOfSample) * samples;
  const double x = std::floor(place.x * per_pixel + 0.5);
  const double y = std::floor(place.y * per_pixel + 0.5);
  if (!(std::abs(x) <= kFarthest && std::abs(y) <= kFarthest)) return {};
  return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), true, place.depth};
}

// What is to the right of the way from one point to the other is above 0; y grows downwards.
SnappedTriangle::Side SnappedTriangle::side_of(const SnappedPoint& from, const SnappedPoint& to) {
  const std::int64_t dx = std::int64_t{to.x} - from.x, dy = std::int64_t{to.y} - from.y;
  Side side;
  side.per_column = -dy * kStepsOfSample;
  side.per_row = dx * kStepsOfSample;
  side.start = dx * (kMiddle - from.y) - dy * (kMiddle - from.x);
  const bool is_left_or_upper = dy < 0 || (dy == 0 && dx > 0);
  side.least = is_left_or_upper ? 0 : 1;
  return side;
}

SnappedTriangle::SnappedTriangle(const SnappedPoint& a, const SnappedPoint& b,
                                 const SnappedPoint& c)
    : depths_{a.depth, b.depth, c.depth},
      least_depth_(std::min({a.depth, b.depth, c.depth})),
      most_depth_(std::max({a.depth, b.depth, c.depth})),
      top_(std::min({a.y, b.y, c.y})),
      bottom_(std::max({a.y, b.y, c.y})) {
  twice_area_ = (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
                (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
  clockwise_ = twice_area_ >= 0;
  if (clockwise_) {
    sides_ = {side_of(b, c), side_of(c, a), side_of(a, b)};
  } else {
    twice_area_ = -twice_area_;
    sides_ = {side_of(c, b), side_of(a, c), side_of(b, a)};
  }
}

Range SnappedTriangle::rows(const Range& all) const {
  return {std::max(all.first, first_from(top_)), std::min(all.end, first_from(bottom_ + 1))};
}

Range SnappedTriangle::covered(std::int64_t row, const Range& all) const {
  Range range = all;
  for (const Side& side : sides_) {
    const std::int64_t missing = side.least - side.start - row * side.per_row;
    if (side.per_column > 0) {
      range.first = std::max(range.first, ceiling_of(missing, side.per_column));
    } else if (side.per_column < 0) {
      range.end = std::min(range.end, floor_of(-missing, -side.per_column) + 1);
    } else if (missing > 0) {
      return {};
    }
  }
  return range;
}

Weights SnappedTriangle::weights(std::int64_t column, std::int64_t row) const {
  Weights weights;
  for (std::size_t k = 0; k < 3; ++k) {
    const Side& side = sides_[k];
    weights[k] = side.start + column * side.per_column + row * side.per_row;
  }
  return weights;
}

Shares SnappedTriangle::shares(std::int64_t column, std::int64_t row) const {
  const Weights parts = weights(column, row);
  const auto whole = static_cast<double>(twice_area_);
  return {static_cast<double>(parts[0]) / whole, static_cast<double>(parts[1]) / whole,
          static_cast<double>(parts[2]) / whole};
}

double SnappedTriangle::depth(std::int64_t column, std::int64_t row) const {
  const Shares share = shares(column, row);
  const double sum = share[0] * depths_[0] + share[1] * depths_[1] + share[2] * depths_[2];
  return std::clamp(sum, least_depth_, most_depth_);
}

}  // namespace meshrepair
