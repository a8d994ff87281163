// SPDX-License-Identifier: MIT
#include "xml_text.h"

#include <cstddef>
#include <cstdint>

namespace meshrepair {
namespace {

// Bytes of the character of UTF-8 at the start that is not ASCII; 0 if there is none that XML can
// hold.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0xC2   ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  if (length == 0 || text.size() < length) return 0;
  std::uint32_t code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  const bool is_none = code == 0xFFFE || code == 0xFFFF || code > 0x10FFFF;
  return code < kSmallest[length] || is_surrogate || is_none ? 0 : length;
}

void append_ascii(std::string& xml, char c) {
  switch (c) {
    case '&':
      xml += "&amp;";
      return;
    case '<':
      xml += "&lt;";
      return;
    case '>':
      xml += "&gt;";
      return;
    case '"':
      xml += "&quot;";
      return;
    case '\t':
      xml += "&#9;";
      return;
    case '\n':
      xml += "&#10;";
      return;
    case '\r':
      xml += "&#13;";
      return;
    default:
      xml += c < ' ' ? '?' : c;
  }
}

}  // namespace

void append_xml_text(std::string& xml, std::string_view text) {
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text.front());
    if (first < 0x80) {
      append_ascii(xml, text.front());
      text.remove_prefix(1);
      continue;
    }
    const std::size_t length = utf8_length(text);
    if (length > 0) {
      xml += text.substr(0, length);
    } else {
      xml += static_cast<char>(0xC0u | first >> 6);
      xml += static_cast<char>(0x80u | (first & 0x3Fu));
    }
    text.remove_prefix(length > 0 ? length : 1);
  }
}

void append_xml_attribute(std::string& xml, std::string_view name, std::string_view text) {
  xml += ' ';
  xml += name;
  xml += "=\"";
  append_xml_text(xml, text);
  xml += '"';
}

}  // namespace meshrepair
