// SPDX-License-Identifier: MIT
// Files packed by gzip and Zstandard, made by hand where no program would make them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <mesh/packing.h>

#include "package_bytes.h"

namespace meshrepair {

inline std::string gzip_of(std::string_view bytes) { return pack_bytes(bytes, Packing::gzip); }
inline std::string zstd_of(std::string_view bytes) { return pack_bytes(bytes, Packing::zstd); }

// What a member of gzip may say of itself.
struct GzipHeader {
  std::uint8_t method = 8;
  std::uint8_t flags = 0;
  std::string fields = {};   // that the flags ask for
  std::uint32_t crc = 0;     // added to the right one
  std::uint32_t length = 0;  // the same
};

// A member of bytes that are stored as they are: fewer than 65536.
inline std::string gzip_member(std::string_view bytes, const GzipHeader& header = {}) {
  std::string member = "\x1F\x8B";
  member += static_cast<char>(header.method);
  member += static_cast<char>(header.flags);
  member += std::string(4, '\0') + "\x02\x03" + header.fields;
  member += '\x01';  // the last block, stored
  member += little_endian(bytes.size(), 2) + little_endian(~bytes.size(), 2);
  member += bytes;
  return member + little_endian(crc32_of(bytes) + header.crc, 4) +
         little_endian(bytes.size() + header.length, 4);
}

inline const std::string kZstdMagic = "\x28\xB5\x2F\xFD";

// A frame without a checksum and a content size, with a window of 1 KB times 2^log.
inline std::string zstd_frame(const std::string& blocks, int log = 10) {
  return kZstdMagic + '\0' + static_cast<char>(log << 3) + blocks;
}

inline std::string zstd_block(int type, std::size_t size, bool is_last) {
  return little_endian(size << 3 | static_cast<std::size_t>(type) << 1 | (is_last ? 1 : 0), 3);
}

// Bytes as they are: fewer than 128 KB.
inline std::string zstd_raw_block(std::string_view bytes, bool is_last) {
  return zstd_block(0, bytes.size(), is_last).append(bytes);
}

// One byte so many times.
inline std::string zstd_run_block(char byte, std::size_t count, bool is_last) {
  return zstd_block(1, count, is_last) + byte;
}

inline std::string zstd_skippable(std::string_view bytes) {
  return ("\x53\x2A\x4D\x18" + little_endian(bytes.size(), 4)).append(bytes);
}

}  // namespace meshrepair
