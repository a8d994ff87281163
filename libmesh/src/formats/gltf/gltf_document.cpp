// SPDX-License-Identifier: MIT
#include "gltf_document.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace meshrepair {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

constexpr std::size_t kFileHeader = 12;
constexpr std::size_t kChunkHeader = 8;

// Of objects and lists in each other. Files have about ten; writing goes down by calls.
constexpr std::size_t kMostDepth = 128;

std::uint32_t uint32_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

bool is_too_deep(std::string_view text) {
  std::size_t depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text) {
      if (c == '\\') ++i;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMostDepth) return true;
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return false;
}

// What a reader of triangles may pass over, or understands.
bool is_known_extension(std::string_view name) {
  constexpr std::array<std::string_view, 4> kUnderstood = {
      "KHR_mesh_quantization", "KHR_draco_mesh_compression", "EXT_meshopt_compression",
      "EXT_mesh_gpu_instancing"};
  constexpr std::array<std::string_view, 10> kOfLooks = {
      "KHR_materials_", "EXT_materials_", "KHR_texture_", "EXT_texture_",  "MSFT_texture_",
      "KHR_lights_",    "EXT_lights_",    "KHR_xmp",      "MSFT_packing_", "KHR_techniques_webgl"};
  return std::find(kUnderstood.begin(), kUnderstood.end(), name) != kUnderstood.end() ||
         std::any_of(kOfLooks.begin(), kOfLooks.end(),
                     [&](std::string_view begin) { return name.starts_with(begin); });
}

}  // namespace

GltfDocument::GltfDocument(const MeshSource& source) : source_(source) {
  is_binary_ = source.bytes.starts_with("glTF");
  parse(is_binary_ ? take_chunks() : source.bytes);
  if (!root_.is_object()) source_.fail("is no glTF: its JSON is no object");
  check_version();
  check_extensions();
}

std::string_view GltfDocument::take_chunks() {
  std::string_view rest = source_.bytes;
  if (rest.size() < kFileHeader + kChunkHeader) {
    source_.fail("a binary glTF cut within its first 20 bytes");
  }
  const std::uint32_t version = uint32_at(rest, 4);
  if (version != 2) {
    source_.fail("is binary glTF of version " + std::to_string(version) + "; 2 can be read");
  }
  const std::size_t size = uint32_at(rest, 8);
  if (size > rest.size()) {
    source_.fail("a binary glTF cut short: it promises " + std::to_string(size) +
                 " bytes and has " + std::to_string(rest.size()));
  }
  trailing_bytes_ = rest.size() - std::max(size, kFileHeader);
  rest = rest.substr(0, size);
  rest.remove_prefix(std::min(kFileHeader, rest.size()));
  std::optional<std::string_view> json;
  while (rest.size() >= kChunkHeader) {
    const std::size_t length = uint32_at(rest, 0);
    const std::string_view kind = rest.substr(4, 4);
    rest.remove_prefix(kChunkHeader);
    if (length > rest.size()) source_.fail("a binary glTF with a chunk longer than the file");
    const std::string_view chunk = rest.substr(0, length);
    rest.remove_prefix(length);
    if (!json) {
      if (kind != "JSON") source_.fail("a binary glTF whose first chunk is not its JSON");
      json = chunk;
    } else if (!binary_ && kind == std::string_view("BIN\0", 4)) {
      binary_ = chunk;
    }
  }
  if (!json) source_.fail("a binary glTF without JSON");
  return *json;
}

void GltfDocument::parse(std::string_view text) {
  if (is_too_deep(text)) {
    source_.fail("its JSON has more than " + std::to_string(kMostDepth) +
                 " objects and lists in each other");
  }
  try {
    root_ = GltfJson::parse(text.begin(), text.end());
  } catch (const GltfJson::parse_error& error) {
    source_.fail("is no glTF: its JSON goes wrong at byte " + std::to_string(error.byte));
  } catch (const GltfJson::exception&) {
    source_.fail("is no glTF: its JSON has a number that is too large");
  }
}

void GltfDocument::check_version() const {
  const GltfJson* const asset = gltf_member(root_, "asset");
  if (asset == nullptr) source_.fail("is no glTF: its JSON has no asset");
  const std::string version = gltf_text(*asset, "version");
  if (!version.empty() && !version.starts_with("2.")) {
    source_.fail("is glTF of version " + printable(version) + "; 2.0 can be read");
  }
}

void GltfDocument::check_extensions() const {
  const GltfJson* const required = gltf_member(root_, "extensionsRequired");
  if (required == nullptr || !required->is_array()) return;
  for (const GltfJson& extension : *required) {
    if (!extension.is_string()) continue;
    const auto& name = extension.get_ref<const std::string&>();
    if (!is_known_extension(name)) {
      source_.fail("needs the glTF extension " + printable(name) + ", which cannot be read");
    }
  }
}

std::size_t GltfDocument::count(const char* list) const {
  const GltfJson* const entries = gltf_member(root_, list);
  return entries != nullptr && entries->is_array() ? entries->size() : 0;
}

const GltfJson& GltfDocument::entry(const char* list, std::size_t number) const {
  if (number >= count(list)) {
    source_.fail("names " + std::string(list) + "[" + std::to_string(number) +
                 "], which is not there");
  }
  return root_[list][number];
}

std::optional<std::size_t> GltfDocument::whole(const GltfJson& object, const char* key) const {
  const GltfJson* const value = gltf_member(object, key);
  if (value == nullptr) return std::nullopt;
  return whole_of(*value, key);
}

std::size_t GltfDocument::whole(const GltfJson& object, const char* key,
                                std::size_t otherwise) const {
  return whole(object, key).value_or(otherwise);
}

std::size_t GltfDocument::required_whole(const GltfJson& object, const char* key) const {
  const std::optional<std::size_t> value = whole(object, key);
  if (!value) source_.fail("its JSON lacks the number '" + std::string(key) + "'");
  return *value;
}

std::size_t GltfDocument::whole_of(const GltfJson& value, const char* what) const {
  // 2^53: doubles hold all whole numbers below.
  constexpr double kMost = 9007199254740992.0;
  if (value.is_number_unsigned()) return gltf_whole(value);
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number >= 0 && number < kMost && number == std::floor(number)) {
      return within(static_cast<std::uint64_t>(number), std::numeric_limits<std::size_t>::max());
    }
  }
  source_.fail("its JSON has a '" + std::string(what) + "' that is no whole number from 0 on");
}

}  // namespace meshrepair
