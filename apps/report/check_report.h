// SPDX-License-Identifier: MIT
// What meshcheck has found, for people, for scripts and for the eye.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <check/check_surface.h>
#include <mesh/coloured_ply.h>
#include <mesh/length_unit.h>

#include "report/json_report.h"

namespace meshrepair {

// A table: each defect with its number and the first places, the measures, and the verdict.
// `what` is the line about what was read, `attributes` what the triangles carry.
[[nodiscard]] std::string check_table(const SurfaceCheck& check, const std::string& what,
                                      const std::vector<std::string>& attributes,
                                      std::optional<LengthUnit> unit);

// The section "check" of the report.
[[nodiscard]] Json check_section(const SurfaceCheck& check);

// The worst defect of each triangle as a colour, or what of it is thin if it has none; no colours
// if triangles are not marked. `thin` are ThinReport::marks, or none.
[[nodiscard]] std::vector<Colour> defect_colours(const SurfaceCheck& check,
                                                 std::span<const std::uint8_t> thin = {});

struct DefectLook {
  Defect defect;
  std::string_view words;
  Colour colour;
  bool is_marked;  // triangles have marks of it
};

// Of all defects; the worst that triangles are marked with first, then the others.
[[nodiscard]] std::vector<DefectLook> defect_looks();

// "red  triangles that intersect others", ...: one line for each colour.
[[nodiscard]] std::vector<std::string> colour_legend();

}  // namespace meshrepair
