// SPDX-License-Identifier: MIT
#include "value_type.h"

namespace meshrepair {

std::size_t size_of(ValueType type) {
  switch (type) {
    case ValueType::int8:
    case ValueType::uint8:
      return 1;
    case ValueType::int16:
    case ValueType::uint16:
      return 2;
    case ValueType::int32:
    case ValueType::uint32:
    case ValueType::float32:
      return 4;
    default:
      return 8;
  }
}

}  // namespace meshrepair
