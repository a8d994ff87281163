// SPDX-License-Identifier: MIT
// Values of attributes in 3D model parts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <base/ids.h>
#include <mesh/attributes.h>
#include <mesh/placement.h>

namespace meshrepair {

// False, and NaN, where it is no number. "nan" and "inf" are numbers here, as in other formats.
[[nodiscard]] bool read_model_number(std::string_view text, double& value);

// An id or an index, below 2^31; kNone where it is none.
[[nodiscard]] std::uint32_t read_model_index(std::string_view text);

// Takes the first word off `text`; empty at its end.
[[nodiscard]] std::string_view take_word(std::string_view& text);

struct ModelColour {
  std::array<double, 4> values = {1, 1, 1, 1};
  bool has_opacity = false;
};

// "#RRGGBB" or "#RRGGBBAA".
[[nodiscard]] std::optional<ModelColour> read_model_colour(std::string_view text);

// Twelve numbers, all finite: x' = x m0 + y m3 + z m6 + m9, y' = x m1 + ... Nothing where it is no
// such thing.
[[nodiscard]] std::optional<Placement> read_placement(std::string_view text);

// What tilestyleu, tilestylev and filter say; what is missing or unknown is what it is by default.
[[nodiscard]] TextureSampling read_sampling(std::string_view tile_u, std::string_view tile_v,
                                            std::string_view filter);

// The words for these.
[[nodiscard]] std::string_view tile_name(TextureSampling::Wrap wrap);
[[nodiscard]] std::string_view filter_name(TextureSampling::Filter filter);

}  // namespace meshrepair
