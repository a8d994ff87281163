// SPDX-License-Identifier: MIT
// What attributes of corners are called where they stand in one list.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <mesh/attributes.h>

namespace meshrepair {

// Of the n-th attribute of its kind: "texture", "normal", "tangent", "colour", with "_1" and so on
// behind it from the second one on; others have names of their own.
[[nodiscard]] std::string attribute_key(const CornerAttribute& attribute, std::size_t n);

// `other` for what is none of the keys above.
[[nodiscard]] CornerAttribute::Kind kind_of_key(std::string_view key);

// Throws UsageError, which begins with `name`, where one of this kind cannot have so many numbers.
void check_components(const CornerAttribute& attribute, const std::string& name);

}  // namespace meshrepair
