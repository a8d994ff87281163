// SPDX-License-Identifier: MIT
// What of attributes a file has no place for: words for people.
#pragma once

#include <string>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/soup.h>
#include <mesh/soup_format.h>

namespace meshrepair {

// "texture coordinates", "colours", ..., or the name of the attribute.
[[nodiscard]] std::string kind_words(const CornerAttribute& attribute);

// What is among `all` and not among `held`, or what a file of this format has no place for where it
// stands, each once. `held` is what held_by() leaves, or less.
[[nodiscard]] std::vector<std::string> lost_attributes(const TriangleSoup& soup,
                                                       const Attributes& all,
                                                       const Attributes& held, SoupFormat format);

}  // namespace meshrepair
