// SPDX-License-Identifier: MIT
// What --thickness has found, for people, for scripts and for the eye.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <check/thin_places.h>
#include <mesh/coloured_ply.h>

#include "report/json_report.h"

namespace meshrepair {

struct ThinLook {
  ThinKind kind;
  std::string_view noun;     // for people
  std::string_view section;  // of the report
  std::string_view key;      // in a page, where those of defects are, too
  std::string_view name;     // of the colour
  std::string_view meaning;
  Colour colour;
};

// Worst first.
[[nodiscard]] const std::array<ThinLook, kThinKinds>& thin_looks();

// Of the worst that a triangle is marked with in ThinReport::marks; nothing where it is not thin.
[[nodiscard]] std::optional<Colour> thin_colour(std::uint8_t marks);

// Lines for the table. `is_solid`: the mesh bounds a solid.
[[nodiscard]] std::string thickness_text(const ThinReport& thin, bool is_solid);

// "2 walls, 1 pin"; empty where nothing is thin.
[[nodiscard]] std::string thin_counts(const ThinReport& thin);

// The section "thickness" of the report, and of "check" there.
[[nodiscard]] Json thickness_section(const ThinReport& thin);

// Of each kind only the first `most` places stay.
void keep_places(ThinReport& thin, std::size_t most);

}  // namespace meshrepair
