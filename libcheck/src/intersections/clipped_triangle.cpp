// SPDX-License-Identifier: MIT
#include "clipped_triangle.h"

#include <algorithm>

#include <base/assert.h>

namespace meshrepair::internal {
namespace {

constexpr int kNoAxis = -1;

}  // namespace

ClippedTriangle::ClippedTriangle(const std::array<Vec3d, 3>& corners, const Box& box) {
  std::copy(corners.begin(), corners.end(), corners_.begin());
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.low[static_cast<std::size_t>(axis)];
    const double high = box.high[static_cast<std::size_t>(axis)];
    keep_above([&](const Vec3d& p) { return p[axis] - low; }, axis, low);
    keep_above([&](const Vec3d& p) { return high - p[axis]; }, axis, high);
  }
}

void ClippedTriangle::clip(const Wall& wall) {
  keep_above([&](const Vec3d& p) { return wall.height(p) + kClipMargin; }, kNoAxis, 0);
}

Box ClippedTriangle::box() const {
  Box box;
  for (const Vec3d& corner : corners()) box.add(corner);
  box.widen(kClipMargin);
  return box;
}

template <class Height>
void ClippedTriangle::keep_above(Height height, int axis, double limit) {
  const auto below = [&](const Vec3d& p) { return height(p) < 0; };
  if (std::none_of(corners_.begin(), corners_.begin() + count_, below)) return;
  std::array<Vec3d, kMostCorners> kept;
  std::size_t kept_count = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Vec3d& a = corners_[i];
    const Vec3d& b = corners_[i + 1 == count_ ? 0 : i + 1];
    MESHREPAIR_ASSERT(kept_count + 2 <= kMostCorners);
    if (!below(a)) kept[kept_count++] = a;
    if (below(a) == below(b)) continue;
    const double share = height(a) / (height(a) - height(b));
    kept[kept_count] = a + share * (b - a);
    if (axis != kNoAxis) kept[kept_count][axis] = limit;
    ++kept_count;
  }
  corners_ = kept;
  count_ = kept_count;
}

}  // namespace meshrepair::internal
