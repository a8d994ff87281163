// SPDX-License-Identifier: MIT
// Sections of a .bsp file: writing items one by one, and reading them against what is there.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <base/byte_order.h>
#include <base/error.h>
#include <mesh/mesh_source.h>
#include <mesh/read_guard.h>

namespace meshrepair::internal {

[[nodiscard]] std::uint64_t checksum_of(std::string_view bytes);

template <class Number>
void put_number(std::string& out, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  out.append(raw.data(), raw.size());
}

class SectionWriter {
 public:
  // Appends a section to `out`; the items follow by put(), and finish() ends it.
  SectionWriter(std::string& out, std::string_view name, std::uint32_t item_bytes,
                std::uint64_t items);
  template <class Number>
  void put(Number number) {
    put_number(out_, number);
  }
  void finish();

 private:
  std::string& out_;
  std::size_t checksum_at_;
};

// Walks through the bytes of a file. Every failure is an InputError that names the file and the
// section.
class SectionReader {
 public:
  explicit SectionReader(const MeshSource& source)
      : rest_(source.bytes), source_(source), guard_(source) {}

  // The header of the file, and a plain number of it.
  void skip(std::string_view expected, const std::string& otherwise);
  std::uint32_t header_number();

  // Enters the next section, which must have this name and item size, and returns the number of its
  // items. The section's bytes are all there and its checksum is right.
  std::size_t enter(std::string_view name, std::uint32_t item_bytes);
  template <class Number>
  Number get() {
    const auto number = load<Number>(rest_.data(), std::endian::little);
    rest_.remove_prefix(sizeof(Number));
    return number;
  }
  // To be called for each item; and with the number of triangles.
  void tick() { guard_.step(0, source_.bytes.size() - rest_.size()); }
  void require_at_most(std::size_t triangles) const { guard_.require(triangles); }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

  [[noreturn]] void fail(const std::string& what) const;
  void require(bool holds, const char* what) const {
    if (!holds) fail(what);
  }

 private:
  std::string_view rest_;
  const MeshSource& source_;
  ReadGuard guard_;
  std::string section_ = "header";
};

}  // namespace meshrepair::internal
