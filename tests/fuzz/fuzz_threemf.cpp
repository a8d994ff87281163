// SPDX-License-Identifier: MIT
// Inputs that begin as archives do are read as they are, others as the model of a package.
#include <string>

#include "check_attributes.h"
#include "check_reading.h"
#include "package_bytes.h"

namespace {

void check(std::string_view bytes) {
  using namespace meshrepair;
  ReadOptions options;
  options.attributes = true;
  options.max_triangles = testing::kMostTriangles;
  ReadResult result;
  try {
    result = read_soup(bytes, "any.3mf", options);
  } catch (const LimitError&) {
    return;
  } catch (const InputError& error) {
    testing::require_one_line(error.what());
    return;
  }
  testing::require_valid_indices(result.soup);
  testing::require_consistent(result, bytes.size());
  testing::require_round_trip(result.soup, SoupFormat::threemf);
  std::string written;
  try {
    written = format_soup(result.soup, SoupFormat::threemf, {.attributes = &result.attributes});
  } catch (const OutputError&) {
    return;
  }
  const ReadResult back = read_soup(std::string_view(written), "back.3mf", options);
  testing::require(testing::same_soup(back.soup, result.soup), "comes back as another soup");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace meshrepair;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  if (!bytes.starts_with("PK")) bytes = package_of(bytes);
  check(bytes);
  testing::check_attributes(bytes, "any.3mf", SoupFormat::threemf);
  return 0;
}
