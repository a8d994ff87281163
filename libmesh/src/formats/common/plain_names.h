// SPDX-License-Identifier: MIT
// Names that stand in lines of text files.
#pragma once

#include <optional>
#include <string>

#include <mesh/attributes.h>

namespace meshrepair {

// What names stand in.
enum class NameLines { ply, obj, stl };

// The same attributes with names that fit into a line, do not make the next one part of it, and,
// for OBJ and STL, come back as they are: others have '_' instead of what does not. No two names of
// one list become one. Nothing where all fit already.
[[nodiscard]] std::optional<Attributes> with_plain_names(const Attributes& attributes,
                                                         NameLines lines);

// Of a file that a line of OBJ names.
[[nodiscard]] std::string plain_obj_name(const std::string& name);

}  // namespace meshrepair
