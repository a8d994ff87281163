// SPDX-License-Identifier: MIT
#include "check_attributes.h"
#include "check_reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace meshrepair;
  try {
    testing::check_reading(data, size, "any.gltf");
  } catch (const LimitError&) {  // more instances than there is room for
  }
  testing::check_attributes({reinterpret_cast<const char*>(data), size}, "any.gltf",
                            SoupFormat::glb);
  return 0;
}
