// SPDX-License-Identifier: MIT
#include "check_reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  meshrepair::testing::check_reading(data, size, "any.off");
  return 0;
}
