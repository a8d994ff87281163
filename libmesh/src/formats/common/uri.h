// SPDX-License-Identifier: MIT
// Names of files in links, and texts that stand for bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace meshrepair {

// "data:MEDIA_TYPE;base64,BYTES" taken apart.
struct DataUri {
  std::string media_type;
  std::string bytes;
};

[[nodiscard]] bool is_data_uri(std::string_view uri);

// Nothing if it is none, or its base64 is broken.
[[nodiscard]] std::optional<DataUri> decode_data_uri(std::string_view uri);

// "a%20b" is "a b". What is no such number stays.
[[nodiscard]] std::string decode_percent(std::string_view uri);
// Of a path with '/' between folders.
[[nodiscard]] std::string encode_percent(std::string_view path);

}  // namespace meshrepair
