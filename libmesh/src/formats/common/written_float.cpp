#include "written_float.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <base/decimal.h>
#include <base/error.h>

namespace meshrepair {

float written_float(double coordinate, std::string_view format) {
  if (std::abs(coordinate) > std::numeric_limits<float>::max() && !std::isinf(coordinate)) {
    std::array<char, 32> text;
    const auto end = write_decimal(text.data(), text.data() + text.size(), coordinate);
    std::string message = "a coordinate of ";
    message.append(text.data(), end.ptr).append(" does not fit into ").append(format);
    throw OutputError(message.append("; write another format"));
  }
  return static_cast<float>(coordinate) + 0.0f;  // no -0: as it will be read back
}

}  // namespace meshrepair
