// SPDX-License-Identifier: MIT
#include "check_attributes.h"
#include "check_reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace meshrepair;
  testing::check_reading(data, size, "any.stl");
  testing::check_attributes({reinterpret_cast<const char*>(data), size}, "any.stl",
                            SoupFormat::stl_binary);
  return 0;
}
