// SPDX-License-Identifier: MIT
#include "gltf_builder.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>

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

namespace {

// Those without parents.
std::vector<std::size_t> root_nodes(const GltfJson& root) {
  std::vector<std::size_t> roots;
  const GltfJson* const nodes = gltf_member(root, "nodes");
  if (nodes == nullptr) return roots;
  std::vector<char> is_child(nodes->size(), 0);
  for (const GltfJson& node : *nodes) {
    const GltfJson* const children = gltf_member(node, "children");
    if (children == nullptr) continue;
    for (const GltfJson& child : *children) {
      if (!child.is_number()) continue;
      const auto number = child.get<double>();
      if (number >= 0 && number < static_cast<double>(is_child.size())) {
        is_child[static_cast<std::size_t>(number)] = 1;
      }
    }
  }
  for (std::size_t n = 0; n < is_child.size(); ++n) {
    if (is_child[n] == 0) roots.push_back(n);
  }
  return roots;
}

void show(GltfJson& root, std::size_t number) {
  const auto scenes = root.find("scenes");
  if (scenes == root.end() || !scenes->is_array() || scenes->empty()) {
    root["scenes"] = GltfJson::array({{{"nodes", root_nodes(root)}}});
    root["scene"] = 0;
    return;
  }
  const GltfJson* const chosen = gltf_member(root, "scene");
  const std::size_t scene = chosen == nullptr ? 0 : gltf_whole(*chosen);
  root["scene"] = scene;
  GltfJson& nodes = root["scenes"][scene]["nodes"];
  if (!nodes.is_array()) nodes = GltfJson::array();
  nodes.push_back(number);
}

void set_matrix(const Eigen::Matrix3d& linear, const Vec3d& offset, GltfJson& node) {
  node["matrix"] = {
      linear(0, 0), linear(1, 0), linear(2, 0), 0, linear(0, 1), linear(1, 1), linear(2, 1), 0,
      linear(0, 2), linear(1, 2), linear(2, 2), 0, offset.x(),   offset.y(),   offset.z(),   1};
}

// Whether columns are at right angles, as far as single precision can tell. Others are no product
// of a turn and a scale, and no node may have them.
bool is_of_one_node(const Eigen::Matrix3d& linear) {
  constexpr double kStep = 1e-7;
  const Eigen::Matrix3d squares = linear.transpose() * linear;
  for (int i = 0; i < 3; ++i) {
    for (int k = i + 1; k < 3; ++k) {
      if (std::abs(squares(i, k)) > kStep * std::sqrt(squares(i, i) * squares(k, k))) return false;
    }
  }
  return true;
}

// Any other linear map M is M V times V', and M V has columns at right angles, where V are the
// eigenvectors of M' M.
void place_by_two(GltfBuilder& builder, const Placement& placement, GltfJson& node,
                  GltfJson inner) {
  const Eigen::Matrix3d squares = placement.linear.transpose() * placement.linear;
  const Eigen::Matrix3d v = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares).eigenvectors();
  set_matrix(placement.linear * v, placement.offset, node);
  set_matrix(v.transpose(), Vec3d::Zero(), inner);
  node["children"] = {builder.append("nodes", std::move(inner))};
}

}  // namespace

std::size_t add_gltf_node(GltfBuilder& builder, GltfJson node) {
  const auto name = node.find("name");
  if (name != node.end() && name->is_string() && name->get_ref<const std::string&>().empty()) {
    node.erase("name");
  }
  const std::size_t number = builder.append("nodes", std::move(node));
  show(builder.root(), number);
  return number;
}

void add_gltf_instances(GltfBuilder& builder, const Scene& scene,
                        const std::vector<std::size_t>& numbers, double scale) {
  GltfJson above = GltfJson::array();
  for (const SceneInstance& instance : scene.instances) {
    const std::size_t mesh = numbers[instance.mesh];
    if (mesh == kNoGltfMesh) continue;
    GltfJson node = {{"name", instance.name}};
    if (is_of_one_node(instance.placement.linear)) {
      node["mesh"] = mesh;
      if (!instance.placement.is_identity()) {
        set_matrix(instance.placement.linear, instance.placement.offset, node);
      }
    } else {
      place_by_two(builder, instance.placement, node, {{"mesh", mesh}});
    }
    if (instance.name.empty()) node.erase("name");
    if (scale == 1) {
      add_gltf_node(builder, std::move(node));
    } else {
      above.push_back(builder.append("nodes", std::move(node)));
    }
  }
  if (above.empty()) return;
  add_gltf_node(builder, {{"scale", {scale, scale, scale}}, {"children", std::move(above)}});
}

void renumber_gltf_meshes(GltfBuilder& builder, const std::vector<std::size_t>& numbers) {
  const auto nodes = builder.root().find("nodes");
  if (nodes == builder.root().end()) return;
  for (GltfJson& node : *nodes) {
    const auto mesh = node.find("mesh");
    if (mesh == node.end()) continue;
    const std::size_t number = numbers[gltf_whole(*mesh)];
    if (number == kNoGltfMesh) {
      node.erase("mesh");
    } else {
      *mesh = number;
    }
  }
}

}  // namespace meshrepair
