// SPDX-License-Identifier: MIT
#include "tree_sections.h"

#include <algorithm>

namespace meshrepair::internal {

std::uint64_t checksum_of(std::string_view bytes) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  while (!bytes.empty()) {
    std::array<char, 8> raw{};
    const std::size_t count = std::min(bytes.size(), raw.size());
    std::memcpy(raw.data(), bytes.data(), count);
    hash = (hash ^ load<std::uint64_t>(raw.data(), std::endian::little)) * 0x100000001B3u;
    hash ^= hash >> 32;  // words carry their changes upwards only; bring them down again
    bytes.remove_prefix(count);
  }
  return hash;
}

SectionWriter::SectionWriter(std::string& out, std::string_view name, std::uint32_t item_bytes,
                             std::uint64_t items)
    : out_(out), checksum_at_(0) {
  out_.append(name);
  put(item_bytes);
  put(items);
  checksum_at_ = out_.size();
  put(std::uint64_t{0});
}

void SectionWriter::finish() {
  const std::size_t begin = checksum_at_ + sizeof(std::uint64_t);
  const std::uint64_t sum = checksum_of(std::string_view(out_).substr(begin));
  std::string written;
  put_number(written, sum);
  out_.replace(checksum_at_, written.size(), written);
}

void SectionReader::skip(std::string_view expected, const std::string& otherwise) {
  if (!rest_.starts_with(expected)) throw InputError(source_.name + ": " + otherwise);
  rest_.remove_prefix(expected.size());
}

std::uint32_t SectionReader::header_number() {
  if (rest_.size() < sizeof(std::uint32_t)) fail("is cut");
  return get<std::uint32_t>();
}

std::size_t SectionReader::enter(std::string_view name, std::uint32_t item_bytes) {
  section_ = name;
  constexpr std::size_t kHeader = 4 + 4 + 8 + 8;
  if (rest_.size() < kHeader) fail("is missing: the file ends before it");
  if (!rest_.starts_with(name)) fail("is missing: another one stands in its place");
  rest_.remove_prefix(name.size());
  if (get<std::uint32_t>() != item_bytes) fail("has items of another size");
  const auto promised = get<std::uint64_t>();
  const auto sum = get<std::uint64_t>();
  if (promised > rest_.size() / item_bytes) {
    fail("is cut: it promises " + std::to_string(promised) + " items, the file holds " +
         std::to_string(rest_.size() / item_bytes));
  }
  const auto items = static_cast<std::size_t>(promised);
  if (items >> 31 != 0) fail("has more than 2^31 items");
  if (checksum_of(rest_.substr(0, items * item_bytes)) != sum) {
    fail("is damaged: its checksum is wrong");
  }
  return items;
}

void SectionReader::fail(const std::string& what) const {
  throw InputError(source_.name + ": section " + section_ + " " + what);
}

}  // namespace meshrepair::internal
