#include "gltf_builder.h"

#include <cstdint>
#include <limits>
#include <utility>

#include <base/base64.h>
#include <base/error.h>

namespace meshrepair {
namespace {

void append_uint32(std::string& out, std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void pad(std::string& bytes, char filling) { bytes.append((4 - bytes.size() % 4) % 4, filling); }

std::string as_binary(std::string json, const std::string& buffer) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  pad(json, ' ');
  const std::size_t size = 12 + 8 + json.size() + (buffer.empty() ? 0 : 8 + buffer.size());
  if (size > kMost)
    throw OutputError("a binary glTF holds no more than 4 GB; write another format");
  std::string out = "glTF";
  out.reserve(size);
  append_uint32(out, 2);
  append_uint32(out, size);
  append_uint32(out, json.size());
  out += "JSON" + json;
  if (buffer.empty()) return out;
  append_uint32(out, buffer.size());
  out += std::string_view("BIN\0", 4);
  out += buffer;
  return out;
}

}  // namespace

GltfBuilder::GltfBuilder(const GltfKeepsake* kept) : root_(GltfJson::object()) {
  if (kept != nullptr) root_ = kept->root;
  GltfJson& asset = root_["asset"];
  if (!asset.is_object()) asset = GltfJson::object();
  asset["version"] = "2.0";
  asset["generator"] = "meshrepair";
  if (kept == nullptr) return;
  for (std::size_t i = 0; i < kept->views.size(); ++i) {
    GltfJson& view = root_["bufferViews"][i];
    view["buffer"] = 0;
    view["byteOffset"] = place(*kept->views[i]);
    view["byteLength"] = kept->views[i]->size();
  }
}

std::size_t GltfBuilder::append(const char* list, GltfJson entry) {
  GltfJson& entries = root_[list];
  if (!entries.is_array()) entries = GltfJson::array();
  entries.push_back(std::move(entry));
  return entries.size() - 1;
}

std::size_t GltfBuilder::append_view(std::string_view bytes, Target target, std::size_t stride) {
  GltfJson view = {{"buffer", 0}, {"byteOffset", place(bytes)}, {"byteLength", bytes.size()}};
  if (target != Target::none) view["target"] = static_cast<int>(target);
  if (stride != 0) view["byteStride"] = stride;
  return append("bufferViews", std::move(view));
}

void GltfBuilder::use_extension(const std::string& name) {
  GltfJson& used = root_["extensionsUsed"];
  if (!used.is_array()) used = GltfJson::array();
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

// At a multiple of four, as any number may come next.
std::size_t GltfBuilder::place(std::string_view bytes) {
  pad(buffer_, '\0');
  const std::size_t offset = buffer_.size();
  buffer_ += bytes;
  return offset;
}

std::string GltfBuilder::finish(bool binary) {
  pad(buffer_, '\0');
  if (!buffer_.empty()) {
    GltfJson buffer = {{"byteLength", buffer_.size()}};
    if (!binary) {
      buffer["uri"] = "data:application/octet-stream;base64," + encode_base64(buffer_);
    }
    root_["buffers"] = GltfJson::array({std::move(buffer)});
  }
  // Labels may come from files that are not in UTF-8.
  std::string json = root_.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
  if (binary) return as_binary(std::move(json), buffer_);
  json += '\n';
  return json;
}

}  // namespace meshrepair
