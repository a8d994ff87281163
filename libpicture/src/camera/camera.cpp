// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <base/error.h>
#include <picture/camera.h>

namespace meshrepair {
namespace {

constexpr double kShareFilled = 0.94;  // of the picture's width or height
// Of the largest coordinate. What is smaller is a point, and need not fill the picture.
constexpr double kLeastExtent = 1e-15;

// Sums in one order: Eigen's own depends on its version.
double dot(const Vec3d& a, const Vec3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// t - t^3/3! + ..., for up to an eighth of a turn. The C library's differ in the last bit.
double small_sine(double t) {
  const double s = t * t;
  double sum = 1;
  for (const int k : {18, 16, 14, 12, 10, 8, 6, 4, 2}) sum = 1 - sum * s / (k * (k + 1));
  return t * sum;
}

double small_cosine(double t) {
  const double s = t * t;
  double sum = 1;
  for (const int k : {17, 15, 13, 11, 9, 7, 5, 3, 1}) sum = 1 - sum * s / (k * (k + 1));
  return sum;
}

struct Turn {
  double sine, cosine;
};

Turn turn_of(double degrees) {
  constexpr double kRadians = 0.017453292519943295;  // of a degree
  const double within = std::fmod(degrees, 360);     // exact
  const double quarters = std::floor(within / 90 + 0.5);
  const double rest = (within - 90 * quarters) * kRadians;
  const double sine = small_sine(rest), cosine = small_cosine(rest);
  switch ((static_cast<int>(quarters) + 8) % 4) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double middle() const { return low <= high ? low + (high - low) / 2 : 0; }
  [[nodiscard]] double length() const { return low <= high ? high - low : 0; }
};

using Box = std::array<Extent, 3>;

template <class Visit>
void visit_finite_corners(std::initializer_list<const TriangleSoup*> soups, const Visit& visit) {
  for (const TriangleSoup* soup : soups) {
    for (const auto& triangle : soup->triangles) {
      const bool finite = std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
        const Vec3d& p = soup->points[corner];
        return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
      });
      if (!finite) continue;
      for (const std::uint32_t corner : triangle) visit(soup->points[corner]);
    }
  }
}

}  // namespace

Camera::Camera(const View& view, PictureSize size, std::initializer_list<const TriangleSoup*> soups)
    : size_(size) {
  const auto is_side = [](std::uint32_t side) { return side > 0 && side <= kMostPictureSide; };
  if (!is_side(size.width) || !is_side(size.height)) {
    throw UsageError("a picture's sides have 1 to " + std::to_string(kMostPictureSide) + " pixels");
  }
  const Turn around = turn_of(view.azimuth), above = turn_of(view.elevation);
  right_ = {around.cosine, around.sine, 0};
  upward_ = {-above.sine * around.sine, above.sine * around.cosine, above.cosine};
  towards_ = {above.cosine * around.sine, -above.cosine * around.cosine, above.sine};
  if (view.up == View::Up::y) {
    for (Vec3d* axis : {&right_, &upward_, &towards_})
      *axis = {(*axis)[0], (*axis)[2], -(*axis)[1]};
  }
  fit(soups);
}

void Camera::fit(std::initializer_list<const TriangleSoup*> soups) {
  double largest = 0;
  visit_finite_corners(soups, [&](const Vec3d& p) {
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[axis]));
  });
  constexpr int kLeastExponent = -1000;  // of a number whose inverse is one, too
  unit_ = std::ldexp(1.0, -std::max(largest > 0 ? std::ilogb(largest) : 0, kLeastExponent));
  Box box;
  visit_finite_corners(soups, [&](const Vec3d& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) box[axis].add(p[static_cast<int>(axis)] * unit_);
  });
  middle_ = {box[0].middle(), box[1].middle(), box[2].middle()};
  Box view;
  visit_finite_corners(soups, [&](const Vec3d& p) {
    const Vec3d at = seen(p);
    for (std::size_t axis = 0; axis < 3; ++axis) view[axis].add(at[static_cast<int>(axis)]);
  });
  centre_x_ = view[0].middle();
  centre_y_ = view[1].middle();
  centre_depth_ = view[2].middle();
  scale_ = kShareFilled * std::min(size_.width / std::max(view[0].length(), kLeastExtent),
                                   size_.height / std::max(view[1].length(), kLeastExtent));
  depth_scale_ = 0.5 / std::max(view[2].length(), kLeastExtent);  // others may be in front
}

Vec3d Camera::seen(const Vec3d& point) const {
  const Vec3d from_middle(point[0] * unit_ - middle_[0], point[1] * unit_ - middle_[1],
                          point[2] * unit_ - middle_[2]);
  return {dot(from_middle, right_), dot(from_middle, upward_), dot(from_middle, towards_)};
}

Camera::Place Camera::place(const Vec3d& point) const {
  const Vec3d at = seen(point);
  const double depth = (at[2] - centre_depth_) * depth_scale_ + 0.5;
  return {size_.width * 0.5 + (at[0] - centre_x_) * scale_,
          size_.height * 0.5 - (at[1] - centre_y_) * scale_, std::clamp(depth, 0.0, 1.0)};
}

Vec3d Camera::normal(const Vec3d& a, const Vec3d& b, const Vec3d& c) const {
  const Vec3d from = seen(a), to_b = seen(b) - from, to_c = seen(c) - from;
  const Vec3d across = cross(to_b, to_c);
  const double length = std::sqrt(dot(across, across));
  if (!(length > 0)) return Vec3d::Zero();
  return across / length;
}

double Camera::pixels_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) const {
  const Vec3d from = seen(a), to_b = seen(b) - from, to_c = seen(c) - from;
  return 0.5 * std::abs(cross(to_b, to_c)[2]) * scale_ * scale_;
}

}  // namespace meshrepair
