// SPDX-License-Identifier: MIT
// The types that numbers have in binary files of points.
#pragma once

#include <cstddef>

namespace meshrepair {

enum class ValueType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

// Bytes that a value of the type takes in a binary file.
[[nodiscard]] std::size_t size_of(ValueType type);

}  // namespace meshrepair
