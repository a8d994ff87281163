// SPDX-License-Identifier: MIT
// Pictures that every program can read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "package_bytes.h"

namespace meshrepair {

// A PNG of one pixel.
inline std::string one_pixel_png(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  const auto big_endian = [](std::uint32_t value) {
    const std::string bytes = little_endian(value, 4);
    return std::string(bytes.rbegin(), bytes.rend());
  };
  const auto chunk = [&](const std::string& type, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data +
           big_endian(crc32_of(type + data));
  };
  const std::string header = big_endian(1) + big_endian(1) + std::string("\x08\x02\0\0\0", 5);
  std::string line(1, '\0');  // no filter
  for (const std::uint8_t byte : {red, green, blue}) line += static_cast<char>(byte);
  std::uint32_t a = 1, b = 0;  // Adler's checksum
  for (const char c : line) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const std::string data = "\x78\x01\x01" + little_endian(line.size(), 2) +
                           little_endian(~line.size(), 2) + line + big_endian(b << 16 | a);
  return "\x89PNG\r\n\x1A\n" + chunk("IHDR", header) + chunk("IDAT", data) + chunk("IEND", "");
}

}  // namespace meshrepair
