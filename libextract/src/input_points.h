// Finding the place of a complex vertex in the input's own coordinates.
#pragma once

#include <bsp/clean_soup.h>
#include <bsp/hash_index.h>
#include <bsp/point.h>

namespace meshrepair::internal {

class InputPoints {
 public:
  explicit InputPoints(const CleanSoup& soup);

  // The input point at this place; invalid when there is none.
  [[nodiscard]] PointId find(const Point& point) const;

 private:
  const CleanSoup& soup_;
  HashIndex index_;
};

}  // namespace meshrepair::internal
