// SPDX-License-Identifier: MIT
#include <base/decimal.h>

#include "real_digits.h"

namespace meshrepair::internal {

std::from_chars_result read_real(const char* first, const char* last, double& value) {
  return read_real_digits(first, last, value);
}

std::to_chars_result write_real(char* first, char* last, float value) {
  return write_real_digits(first, last, value);
}

std::to_chars_result write_real(char* first, char* last, double value) {
  return write_real_digits(first, last, value);
}

}  // namespace meshrepair::internal
