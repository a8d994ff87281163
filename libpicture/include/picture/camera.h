// SPDX-License-Identifier: MIT
// From places in space to places in a picture.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <base/vec3.h>
#include <mesh/soup.h>
#include <picture/pixels.h>
#include <picture/view.h>

namespace meshrepair {

inline constexpr std::uint32_t kMostPictureSide = 8192;  // pixels

// All rays are parallel: what is far is not smaller. Only sums, products and roots of doubles, one
// by one, so that the same places come out everywhere.
class Camera {
 public:
  // All triangles of the soups whose corners are finite are in the picture, and as large as they
  // fit. Throws UsageError where a side has no pixels, or more than the most.
  Camera(const View& view, PictureSize size, std::initializer_list<const TriangleSoup*> soups);

  struct Place {
    double x = 0, y = 0;  // pixels from the upper left corner; not finite where the point is not
    double depth = 0;     // from 0 to 1: nearer to whoever looks
  };

  [[nodiscard]] Place place(const Vec3d& point) const;

  // To the right, up, and towards whoever looks; of length 1. Zero for what has no area.
  [[nodiscard]] Vec3d normal(const Vec3d& a, const Vec3d& b, const Vec3d& c) const;

  // The area in pixels that the triangle covers.
  [[nodiscard]] double pixels_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) const;

  [[nodiscard]] PictureSize size() const { return size_; }

 private:
  void fit(std::initializer_list<const TriangleSoup*> soups);
  [[nodiscard]] Vec3d seen(const Vec3d& point) const;

  PictureSize size_;
  Vec3d right_, upward_, towards_;
  // Coordinates times this power of two are at most about 1, so that no difference is too large.
  double unit_ = 1;
  Vec3d middle_ = Vec3d::Zero();  // of the box around all, times unit_
  double centre_x_ = 0, centre_y_ = 0, centre_depth_ = 0;
  double scale_ = 1;  // pixels for each of these units
  double depth_scale_ = 1;
};

}  // namespace meshrepair
