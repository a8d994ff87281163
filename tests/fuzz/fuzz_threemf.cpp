// SPDX-License-Identifier: MIT
// Inputs that begin as archives do are read as they are, others as the model of a package and,
// after a byte 1, what a slicer's project says of it.
#include <array>
#include <string>

#include <mesh/triangle_paint.h>

#include "check_attributes.h"
#include "check_reading.h"
#include "package_bytes.h"

namespace {

std::string package_with_project(const std::string& text) {
  const std::size_t at = text.find('\x01');
  if (at == std::string::npos) return meshrepair::package_of(text);
  const std::string config = text.substr(at + 1);
  return meshrepair::package_of(text.substr(0, at), {{"Metadata/Slic3r_PE_model.config", config},
                                                     {"Metadata/model_settings.config", config}});
}

// Any text is a code, or none; what lies within is one.
void check_paint(const meshrepair::Attributes& attributes) {
  using namespace meshrepair;
  const std::array<PaintPlace, 3> piece = {{{0.7, 0.2, 0.1}, {0.1, 0.6, 0.3}, {0.2, 0.1, 0.7}}};
  for (const TrianglePaint& paint : attributes.paints) {
    for (const std::string& code : paint.codes.names) {
      const std::string within = PaintCode(code).within(piece);
      testing::require(within.empty() || PaintCode(within).main_state().has_value(),
                       "a piece has no code");
    }
  }
}

void check(std::string_view bytes, meshrepair::NegativeVolumes negative) {
  using namespace meshrepair;
  ReadOptions options;
  options.attributes = true;
  options.negative = negative;
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
  for (const PlacedVolume& placed : result.placed) {
    testing::require(placed.first + placed.triangles <= result.soup.triangles.size() &&
                         placed.volume < result.report.volumes.size(),
                     "a volume is not in the soup");
  }
  check_paint(result.attributes);
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
  if (!bytes.starts_with("PK")) bytes = package_with_project(bytes);
  check(bytes, NegativeVolumes::drop);
  check(bytes, NegativeVolumes::subtract);
  testing::check_attributes(bytes, "any.3mf", SoupFormat::threemf);
  return 0;
}
