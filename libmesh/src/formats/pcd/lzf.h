// SPDX-License-Identifier: MIT
// LZF, the compression of binary_compressed PCD files.
//
// A stream of pieces. A control byte below 32 is followed by that many bytes and one, to be copied.
// Of others the upper three bits are a length, the lower five the high bits of a distance: a length
// of 7 is followed by a byte to be added to it; then comes the low byte of the distance. Length
// and two bytes are copied from distance and one bytes before the end of what there is.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace meshrepair {

// Nothing can become larger than this many times its size: three bytes, 264 out.
constexpr std::size_t kMostLzfExpansion = 88;

// What `bytes` stand for, if that is `size` bytes exactly; nothing where they are no LZF. Takes
// memory for `size` bytes, unless it cannot be.
[[nodiscard]] std::optional<std::string> expand_lzf(std::string_view bytes, std::size_t size);

}  // namespace meshrepair
