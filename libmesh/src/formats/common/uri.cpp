// SPDX-License-Identifier: MIT
#include "uri.h"

#include <utility>

#include <base/base64.h>

namespace meshrepair {
namespace {

constexpr std::string_view kHexDigits = "0123456789ABCDEF";

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool is_plain(char c) {
  constexpr std::string_view kPlain = "-._~/";
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         kPlain.find(c) != std::string_view::npos;
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

std::optional<DataUri> decode_data_uri(std::string_view uri) {
  constexpr std::string_view kBase64 = ";base64";
  if (!is_data_uri(uri)) return std::nullopt;
  uri.remove_prefix(5);
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  std::string_view head = uri.substr(0, comma);
  const bool is_base64 = head.ends_with(kBase64);
  if (is_base64) head.remove_suffix(kBase64.size());
  DataUri data{std::string(head.substr(0, head.find(';'))), {}};
  const std::string_view text = uri.substr(comma + 1);
  if (!is_base64) {
    data.bytes = decode_percent(text);
    return data;
  }
  std::optional<std::string> bytes = decode_base64(text);
  if (!bytes) return std::nullopt;
  data.bytes = std::move(*bytes);
  return data;
}

std::string decode_percent(std::string_view uri) {
  std::string path;
  path.reserve(uri.size());
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 &&
        hex_value(uri[i + 2]) >= 0) {
      path += static_cast<char>(16 * hex_value(uri[i + 1]) + hex_value(uri[i + 2]));
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

std::string encode_percent(std::string_view path) {
  std::string uri;
  for (const char c : path) {
    if (is_plain(c)) {
      uri += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    uri += '%';
    uri += kHexDigits[byte >> 4];
    uri += kHexDigits[byte & 15];
  }
  return uri;
}

}  // namespace meshrepair
