// SPDX-License-Identifier: MIT
#include "gltf_buffers.h"

#include <meshoptimizer.h>
#include <optional>
#include <utility>

#include <mesh/named_files.h>

#include "formats/common/uri.h"

namespace meshrepair {
namespace {

// Of bytes of a file none stands for more: of vertices two bits at least for 16 bytes, of
// triangles a byte for three indices.
constexpr std::size_t kMostExpansion = 64;

bool is_possible(const MeshoptLayout& layout, std::size_t bytes) {
  const bool is_good = layout.mode == "ATTRIBUTES"
                           ? layout.stride > 0 && layout.stride <= 256 && layout.stride % 4 == 0
                           : layout.stride == 2 || layout.stride == 4;
  return is_good && layout.count / kMostExpansion <= bytes / layout.stride &&
         (layout.mode != "TRIANGLES" || layout.count % 3 == 0);
}

bool decode(const MeshoptLayout& layout, std::string_view bytes, std::string& decoded) {
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  if (layout.mode == "ATTRIBUTES") {
    return meshopt_decodeVertexBuffer(decoded.data(), layout.count, layout.stride, data,
                                      bytes.size()) == 0;
  }
  if (layout.mode == "TRIANGLES") {
    return meshopt_decodeIndexBuffer(decoded.data(), layout.count, layout.stride, data,
                                     bytes.size()) == 0;
  }
  return layout.mode == "INDICES" &&
         meshopt_decodeIndexSequence(decoded.data(), layout.count, layout.stride, data,
                                     bytes.size()) == 0;
}

bool filter(const MeshoptLayout& layout, std::string& decoded) {
  if (layout.filter.empty() || layout.filter == "NONE") return true;
  if (layout.mode != "ATTRIBUTES") return false;
  if (layout.filter == "OCTAHEDRAL" && (layout.stride == 4 || layout.stride == 8)) {
    meshopt_decodeFilterOct(decoded.data(), layout.count, layout.stride);
  } else if (layout.filter == "QUATERNION" && layout.stride == 8) {
    meshopt_decodeFilterQuat(decoded.data(), layout.count, layout.stride);
  } else if (layout.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(decoded.data(), layout.count, layout.stride);
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::string decode_meshopt(const MeshSource& source, std::string_view bytes,
                           const MeshoptLayout& layout) {
  if (!is_possible(layout, bytes.size())) {
    source.fail("a compressed buffer view cannot hold what it promises");
  }
  std::string decoded(layout.count * layout.stride, '\0');
  if (!decode(layout, bytes, decoded) || !filter(layout, decoded)) {
    source.fail("a compressed buffer view is broken");
  }
  return decoded;
}

std::string_view GltfBuffers::view(std::size_t number) {
  const GltfJson& view = document_.entry("bufferViews", number);
  const GltfJson* const compression = gltf_extension(view, "EXT_meshopt_compression");
  if (compression == nullptr) return part(view);
  const auto [found, is_new] = decompressed_.try_emplace(number);
  if (is_new) found->second = decompress(*compression);
  return found->second;
}

std::string_view GltfBuffers::part(const GltfJson& view) {
  const std::string_view bytes = buffer(document_.required_whole(view, "buffer"));
  const std::size_t offset = document_.whole(view, "byteOffset", 0);
  const std::size_t length = document_.required_whole(view, "byteLength");
  if (offset > bytes.size() || length > bytes.size() - offset) {
    document_.source().fail("a buffer view reaches beyond its buffer, which has " +
                            counted(bytes.size(), "byte"));
  }
  return bytes.substr(offset, length);
}

std::string GltfBuffers::decompress(const GltfJson& compression) {
  const std::string_view bytes = part(compression);
  return decode_meshopt(document_.source(), bytes,
                        {.count = document_.required_whole(compression, "count"),
                         .stride = document_.required_whole(compression, "byteStride"),
                         .mode = gltf_text(compression, "mode"),
                         .filter = gltf_text(compression, "filter")});
}

std::string_view GltfBuffers::buffer(std::size_t number) {
  const auto [found, is_new] = buffers_.try_emplace(number);
  if (is_new) found->second = load(number);
  return found->second.bytes;
}

GltfBuffers::Bytes GltfBuffers::load(std::size_t number) const {
  const MeshSource& source = document_.source();
  const GltfJson& buffer = document_.entry("buffers", number);
  const std::string what = "its buffer " + std::to_string(number);
  const GltfJson* const uri = gltf_member(buffer, "uri");
  if (uri == nullptr) {
    if (number != 0 || !document_.binary()) source.fail(what + " is nowhere");
    return {*document_.binary(), nullptr};
  }
  if (!uri->is_string()) source.fail(what + " has a URI that is no text");
  const auto& name = uri->get_ref<const std::string&>();
  if (is_data_uri(name)) {
    std::optional<DataUri> data = decode_data_uri(name);
    if (!data) source.fail(what + " is a data URI that is broken");
    const auto owner = std::make_shared<const std::string>(std::move(data->bytes));
    return {*owner, owner};
  }
  std::optional<NamedFile> file = read_named(source, decode_percent(name));
  if (!file) {
    source.fail(what + ", " + printable(name) + ", is not in " +
                std::string(place_of_named(source)));
  }
  return {file->bytes, std::move(file->owner)};
}

}  // namespace meshrepair
