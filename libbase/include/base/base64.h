// SPDX-License-Identifier: MIT
// Bytes as text, and back.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace meshrepair {

// As RFC 4648 says, with "=" at the end, in one line.
[[nodiscard]] std::string encode_base64(std::string_view bytes);

// Also what is made for URLs, with or without "=" at the end; nothing if it is neither.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view text);

}  // namespace meshrepair
