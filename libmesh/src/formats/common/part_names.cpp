// SPDX-License-Identifier: MIT
#include "part_names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <vector>

namespace meshrepair {
namespace {

// What "%20" at this place stands for.
std::optional<char> encoded_byte(std::string_view text, std::size_t at) {
  if (text[at] != '%' || text.size() - at < 3) return std::nullopt;
  unsigned byte = 0;
  const char* const first = text.data() + at + 1;
  const auto [end, error] = std::from_chars(first, first + 2, byte, 16);
  if (error != std::errc() || end != first + 2) return std::nullopt;
  return static_cast<char>(byte);
}

bool is_plain_in_names(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || std::string_view("/-._~!$&'()*+,;=@").find(c) != std::string_view::npos;
}

std::string_view folder_of_part(std::string_view part) {
  const std::size_t slash = part.rfind('/');
  return slash == std::string_view::npos ? std::string_view() : part.substr(0, slash);
}

}  // namespace

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

std::string percent_decoded(std::string_view name) {
  std::string decoded;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto byte = encoded_byte(name, i);
    decoded += byte.value_or(name[i]);
    if (byte) i += 2;
  }
  return decoded;
}

std::string percent_encoded(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string encoded;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (is_plain_in_names(name[i]) || encoded_byte(name, i)) {
      encoded += name[i];
      continue;
    }
    const auto byte = static_cast<unsigned char>(name[i]);
    encoded += '%';
    encoded += kDigits[byte / 16];
    encoded += kDigits[byte % 16];
  }
  return encoded;
}

bool is_part_name(std::string_view name) {
  if (name.empty() || name.front() == '/' || name.find(':') != std::string_view::npos) return false;
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; };
  if (std::any_of(name.begin(), name.end(), is_control)) return false;
  while (true) {
    const std::size_t end = std::min(name.find('/'), name.size());
    const std::string_view segment = name.substr(0, end);
    if (segment.empty() || segment == "." || segment == "..") return false;
    if (end == name.size()) return true;
    name.remove_prefix(end + 1);
  }
}

std::string part_key(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return in_lower_case(percent_decoded(name));
}

std::string part_name(std::string_view path, std::string_view base) {
  std::string whole = percent_decoded(path);
  if (!whole.starts_with('/')) whole = std::string(folder_of_part(base)) + "/" + whole;
  std::vector<std::string_view> segments;
  std::string_view rest = whole;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    const std::string_view segment = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (segment.empty() || segment == ".") continue;
    if (segment == "..") {
      if (segments.empty()) return {};
      segments.pop_back();
    } else {
      segments.push_back(segment);
    }
  }
  std::string name;
  for (const std::string_view segment : segments) {
    if (!name.empty()) name += '/';
    name += segment;
  }
  return name;
}

std::string relationships_part_of(std::string_view part) {
  std::string name(folder_of_part(part));
  if (!name.empty()) name += '/';
  return name + "_rels/" + std::string(last_of_part(part)) + ".rels";
}

std::string extension_of_part(std::string_view part) {
  const std::string_view name = last_of_part(part);
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string() : in_lower_case(name.substr(dot + 1));
}

std::string_view last_of_part(std::string_view part) { return part.substr(part.rfind('/') + 1); }

}  // namespace meshrepair
