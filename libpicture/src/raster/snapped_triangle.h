// SPDX-License-Identifier: MIT
// Triangles on a fixed grid of the picture, and which samples they cover: in whole numbers, so that
// triangles with a common edge leave no sample out between them, and share none.
#pragma once

#include <array>
#include <cstdint>

#include <picture/camera.h>

namespace meshrepair {

// How finely a pixel is divided: into samples, at whose middles colours are found, and these into
// steps, on which corners lie.
inline constexpr std::int64_t kStepsOfSample = 256;

struct SnappedPoint {
  std::int32_t x = 0, y = 0;  // steps from the upper left corner of the picture
  bool shown = false;         // else it is not finite, or too far away for whole numbers
  double depth = 0;
};

// `samples` along each side of a pixel.
[[nodiscard]] SnappedPoint snapped(const Camera::Place& place, unsigned samples);

struct Range {
  std::int64_t first = 0, end = 0;

  [[nodiscard]] bool empty() const { return first >= end; }
};

// Twice the areas of the triangles that a sample makes with the sides opposite to the corners.
using Weights = std::array<std::int64_t, 3>;
using Shares = std::array<double, 3>;

class SnappedTriangle {
 public:
  SnappedTriangle(const SnappedPoint& a, const SnappedPoint& b, const SnappedPoint& c);

  // Nothing is covered.
  [[nodiscard]] bool empty() const { return twice_area_ == 0; }
  // Corners follow each other clockwise as one looks at the picture.
  [[nodiscard]] bool clockwise() const { return clockwise_; }

  // Rows of samples whose middles are within its height, of those in `all`.
  [[nodiscard]] Range rows(const Range& all) const;
  // Of a row what it covers: samples whose middle is inside, or on a left or upper side.
  [[nodiscard]] Range covered(std::int64_t row, const Range& all) const;

  // All three are 0 or more where it is covered; they sum to twice_area().
  [[nodiscard]] Weights weights(std::int64_t column, std::int64_t row) const;
  [[nodiscard]] std::int64_t twice_area() const { return twice_area_; }

  // Of each corner at a sample; they sum to 1.
  [[nodiscard]] Shares shares(std::int64_t column, std::int64_t row) const;
  // At a sample that is covered.
  [[nodiscard]] double depth(std::int64_t column, std::int64_t row) const;

 private:
  // w = start + column * per_column + row * per_row at the middle of a sample.
  struct Side {
    std::int64_t start = 0, per_column = 0, per_row = 0;
    std::int64_t least = 0;  // that a sample needs: 0 where the side itself belongs to the triangle
  };
  static Side side_of(const SnappedPoint& from, const SnappedPoint& to);

  std::array<Side, 3> sides_;
  std::array<double, 3> depths_;
  double least_depth_, most_depth_;
  std::int64_t twice_area_ = 0;
  std::int64_t top_ = 0, bottom_ = 0;
  bool clockwise_ = true;
};

}  // namespace meshrepair
