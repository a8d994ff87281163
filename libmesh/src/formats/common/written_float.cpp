// SPDX-License-Identifier: MIT
#include "written_float.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include <base/error.h>

namespace meshrepair {

float written_float(double coordinate, std::string_view format) {
  if (std::abs(coordinate) > std::numeric_limits<float>::max() && !std::isinf(coordinate)) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.6g", coordinate);
    std::replace(text.begin(), text.end(), ',', '.');  // as some locales have it
    throw OutputError(std::string("a coordinate of ") + text.data() + " does not fit into " +
                      std::string(format) + "; write another format");
  }
  return static_cast<float>(coordinate) + 0.0f;  // no -0: as it will be read back
}

}  // namespace meshrepair
