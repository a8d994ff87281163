// SPDX-License-Identifier: MIT
// Numbers in decimal, in any locale: std::from_chars and std::to_chars, also where the standard
// library has these for integers alone. Either way the number that is read is the nearest, and what
// is written are the fewest digits that are read back as the same bits, laid out alike.
#pragma once

#include <charconv>
#include <type_traits>
#include <version>

namespace meshrepair {

#ifdef __cpp_lib_to_chars

template <class Number>
std::from_chars_result read_decimal(const char* first, const char* last, Number& value) {
  return std::from_chars(first, last, value);
}

template <class Number>
std::to_chars_result write_decimal(char* first, char* last, Number value) {
  return std::to_chars(first, last, value);
}

#else

namespace internal {

std::from_chars_result read_real(const char* first, const char* last, double& value);
std::to_chars_result write_real(char* first, char* last, float value);
std::to_chars_result write_real(char* first, char* last, double value);

}  // namespace internal

template <class Number>
std::from_chars_result read_decimal(const char* first, const char* last, Number& value) {
  if constexpr (std::is_floating_point_v<Number>) {
    return internal::read_real(first, last, value);
  } else {
    return std::from_chars(first, last, value);
  }
}

template <class Number>
std::to_chars_result write_decimal(char* first, char* last, Number value) {
  if constexpr (std::is_floating_point_v<Number>) {
    return internal::write_real(first, last, value);
  } else {
    return std::to_chars(first, last, value);
  }
}

#endif

}  // namespace meshrepair
