// SPDX-License-Identifier: MIT
// Numbers, units and names as people read them, in tables, summaries and messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <mesh/length_unit.h>
#include <mesh/packing.h>
#include <mesh/scene.h>

namespace meshrepair {

// 1234567 as "1,234,567", whatever the locale.
[[nodiscard]] std::string grouped(std::uint64_t number);

// "1 triangle", "1,200 triangles".
[[nodiscard]] std::string number_of(std::uint64_t count, std::string_view noun);

// With the plural of a noun that has another one than with an s.
[[nodiscard]] std::string number_of(std::uint64_t count, std::string_view noun,
                                    std::string_view plural);

// "a; b".
[[nodiscard]] std::string joined_with(std::string_view mark, const std::vector<std::string>& words);

// "the input's units" where the unit is not known.
[[nodiscard]] std::string units_text(std::optional<LengthUnit> unit);

// "OBJ", "OBJ in gzip", "OBJ in ZIP, part.obj": what was read.
[[nodiscard]] std::string format_words(std::string_view format, const PackedFile& packed);

// Of a mesh, for people; if it has none, by its number.
[[nodiscard]] std::string mesh_name(const Scene& scene, std::size_t mesh);

}  // namespace meshrepair
