// Finding the place of a complex vertex in the input's own coordinates.
#pragma once

#include <bsp/clean_soup.h>
#include <bsp/hash_index.h>
#include <bsp/point.h>

namespace meshrepair::internal {

class InputPoints {
 public:
  explicit InputPoints(const CleanSoup& soup);

  // The original coordinates of an input point, bit for bit; otherwise the rounded exact place.
  [[nodiscard]] Vec3d place(const Point& point, const PlaneTable& planes) const;

 private:
  const CleanSoup& soup_;
  HashIndex index_;
};

}  // namespace meshrepair::internal
