// SPDX-License-Identifier: MIT
// Where the pictures of materials lie on triangles.
#pragma once

#include <optional>
#include <string>
#include <unordered_set>

#include <mesh/attributes.h>

namespace meshrepair {

// The same attributes, but all pictures lie where the first set of texture coordinates says, with
// no transform: most formats, and whoever draws, know no more. That set comes before the others.
// Materials with the names in `but` keep their transforms for themselves. Nothing where it is so
// already.
[[nodiscard]] std::optional<Attributes> with_placed_pictures(
    const Attributes& attributes, const std::unordered_set<std::string>& but = {});

}  // namespace meshrepair
