#include "check_reading.h"

namespace {

using namespace meshrepair;

// What is read with all that comes with it is written, and read again.
void check_attributes(std::string_view bytes) {
  ReadOptions options;
  options.attributes = true;
  ReadResult read;
  try {
    read = read_soup(bytes, "any.gltf", options);
  } catch (const InputError& error) {
    meshrepair::testing::require_one_line(error.what());
    return;
  }
  for (const CornerAttribute& set : read.attributes.corners) {
    meshrepair::testing::require(set.of_corner.size() == 3 * read.soup.triangles.size(),
                                 "corners are missing");
    for (const std::uint32_t value : set.of_corner) {
      meshrepair::testing::require(value == kNone || value < set.count(), "a value is missing");
    }
  }
  if (meshrepair::testing::overflows_float32(read.soup)) return;
  const std::string written = format_soup(
      read.soup, SoupFormat::glb, {.comments = {"comment"}, .attributes = &read.attributes});
  const ReadResult back = read_soup(std::string_view(written), "back", options);
  meshrepair::testing::require(back.soup.triangles.size() == read.soup.triangles.size(),
                               "triangles are lost");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    meshrepair::testing::check_reading(data, size, "any.gltf");
    check_attributes({reinterpret_cast<const char*>(data), size});
  } catch (const LimitError&) {  // more instances than there is room for
  }
  return 0;
}
