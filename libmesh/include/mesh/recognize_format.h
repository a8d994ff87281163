// SPDX-License-Identifier: MIT
// Which mesh format a file is in.
#pragma once

#include <optional>
#include <string_view>

#include <mesh/reading.h>

namespace meshrepair {

// Told by the content alone; nothing when it fits no format beyond doubt. A binary STL with a wrong
// count, for one, looks like any other bytes. The two PLY formats are not told apart.
[[nodiscard]] std::optional<SoupFormat> recognize_content(std::string_view bytes);

// A .bsp file begins with this (tree_io.h of libbsp). Readers of meshes have to know it, to say
// what they were given.
inline constexpr std::string_view kTreeSignature("BSP\r\n\x1A\n\0", 8);

// As far as text mode transfers leave the signature alone.
[[nodiscard]] bool looks_like_tree(std::string_view bytes);

// What the file is when it is no mesh format of ours but one that people try: "a STEP file".
// Empty if it is not known.
[[nodiscard]] std::string_view name_foreign_format(std::string_view bytes);

}  // namespace meshrepair
