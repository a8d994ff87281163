// Points that are put into a clean soup.
#pragma once

#include <optional>

#include <base/hash_index.h>
#include <bsp/clean_soup.h>

namespace meshrepair::internal {

class NewPoints {
 public:
  // The soup outlives this, and gets no points otherwise.
  explicit NewPoints(CleanSoup& soup) : soup_(soup) {}

  // The nearest point of the grid to a place in grid coordinates: one that the soup has already, or
  // a new one.
  PointId add(const Vec3d& at);

 private:
  void index_all();

  CleanSoup& soup_;
  std::optional<HashIndex> index_;  // of all points, once one is added
};

}  // namespace meshrepair::internal
