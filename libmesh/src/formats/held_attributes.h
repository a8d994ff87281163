// SPDX-License-Identifier: MIT
// Attributes as a format has them.
#pragma once

#include <optional>

#include <mesh/attributes.h>
#include <mesh/soup_format.h>

namespace meshrepair {

// With all pictures where the format can say that they lie: see with_placed_pictures(). Nothing
// where they are there.
[[nodiscard]] std::optional<Attributes> placed_for(SoupFormat format, const Attributes& attributes);

}  // namespace meshrepair
