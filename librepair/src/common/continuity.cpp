// SPDX-License-Identifier: MIT
#include "continuity.h"

#include <algorithm>
#include <limits>

namespace meshrepair::internal {

double extent_of(const CornerAttribute& attribute) {
  if (attribute.kind == CornerAttribute::Kind::normal ||
      attribute.kind == CornerAttribute::Kind::tangent) {
    return 1;
  }
  double extent = 0;
  for (std::size_t c = 0; c < attribute.components; ++c) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = c; i < attribute.values.size(); i += attribute.components) {
      least = std::min(least, attribute.values[i]);
      most = std::max(most, attribute.values[i]);
    }
    if (most > least) extent = std::max(extent, most - least);
  }
  return extent;
}

}  // namespace meshrepair::internal
