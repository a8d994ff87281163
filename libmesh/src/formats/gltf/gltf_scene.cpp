// SPDX-License-Identifier: MIT
#include "gltf_scene.h"

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "gltf_accessor.h"

namespace meshrepair {
namespace {

Eigen::Matrix3d rotation_of(const std::array<double, 4>& q) {
  const double squares = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(squares > 0)) return Eigen::Matrix3d::Identity();
  const double s = 2 / squares;
  const auto& [x, y, z, w] = q;
  Eigen::Matrix3d m;
  m << 1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w),  //
      s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w),   //
      s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y);
  return m;
}

Placement placement_of(const Vec3d& offset, const std::array<double, 4>& rotation,
                       const Vec3d& scale) {
  return {rotation_of(rotation) * scale.asDiagonal(), offset};
}

// So many numbers, if the member is there.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> numbers_in(const GltfDocument& document,
                                                     const GltfJson& object, const char* key) {
  const GltfJson* const list = gltf_member(object, key);
  if (list == nullptr) return std::nullopt;
  std::array<double, kCount> numbers{};
  bool is_good = list->is_array() && list->size() == kCount;
  for (std::size_t i = 0; is_good && i < kCount; ++i) {
    is_good = (*list)[i].is_number();
    if (is_good) numbers[i] = (*list)[i].template get<double>();
  }
  if (!is_good) {
    document.source().fail("a node has a '" + std::string(key) + "' that is not " +
                           std::to_string(kCount) + " numbers");
  }
  return numbers;
}

Placement placement_of_node(const GltfDocument& document, const GltfJson& node) {
  if (const auto m = numbers_in<16>(document, node, "matrix")) {
    Placement placement;
    placement.linear << (*m)[0], (*m)[4], (*m)[8],  //
        (*m)[1], (*m)[5], (*m)[9],                  //
        (*m)[2], (*m)[6], (*m)[10];
    placement.offset = Vec3d((*m)[12], (*m)[13], (*m)[14]);
    return placement;
  }
  const auto t = numbers_in<3>(document, node, "translation");
  const auto r = numbers_in<4>(document, node, "rotation");
  const auto s = numbers_in<3>(document, node, "scale");
  return placement_of(t ? Vec3d((*t)[0], (*t)[1], (*t)[2]) : Vec3d(0, 0, 0),
                      r.value_or(std::array<double, 4>{0, 0, 0, 1}),
                      s ? Vec3d((*s)[0], (*s)[1], (*s)[2]) : Vec3d(1, 1, 1));
}

// What EXT_mesh_gpu_instancing says of one node's mesh.
class InstanceList {
 public:
  InstanceList(const GltfDocument& document, GltfBuffers& buffers, const GltfJson& extension) {
    const GltfJson* const attributes = gltf_member(extension, "attributes");
    if (attributes == nullptr) return;
    const auto read = [&](const char* name, std::size_t components) -> GltfAccessor {
      const std::optional<std::size_t> accessor = document.whole(*attributes, name);
      if (!accessor) return {};
      GltfAccessor read_accessor(document, buffers, *accessor);
      const std::size_t count = read_accessor.count();
      if (read_accessor.components() != components || (count_ && *count_ != count)) {
        document.source().fail("a node has instances that do not fit together");
      }
      count_ = count;
      return read_accessor;
    };
    offsets_ = read("TRANSLATION", 3);
    rotations_ = read("ROTATION", 4);
    scales_ = read("SCALE", 3);
  }

  [[nodiscard]] std::size_t count() const { return count_.value_or(0); }

  [[nodiscard]] Placement operator[](std::size_t i) const {
    std::array<double, 4> rotation = {0, 0, 0, 1};
    for (std::size_t k = 0; k < 4 && rotations_.count() > 0; ++k)
      rotation[k] = rotations_.value(i, k);
    return placement_of(vector_at(offsets_, i, Vec3d(0, 0, 0)), rotation,
                        vector_at(scales_, i, Vec3d(1, 1, 1)));
  }

 private:
  static Vec3d vector_at(const GltfAccessor& accessor, std::size_t i, const Vec3d& otherwise) {
    if (accessor.count() == 0) return otherwise;
    return {accessor.value(i, 0), accessor.value(i, 1), accessor.value(i, 2)};
  }

  std::optional<std::size_t> count_;
  GltfAccessor offsets_, rotations_, scales_;
};

class SceneReader {
 public:
  SceneReader(const GltfDocument& document, GltfBuffers& buffers)
      : document_(document), buffers_(buffers), is_visited_(document.count("nodes"), 0) {}

  std::vector<GltfInstance> run() {
    push(roots(), {}, false);
    while (!open_.empty()) {
      const Open next = open_.back();
      open_.pop_back();
      visit(next);
    }
    return std::move(instances_);
  }

 private:
  struct Open {
    std::size_t node;
    Placement parent;
    bool is_hidden;
  };

  [[nodiscard]] std::vector<std::size_t> numbers(const GltfJson& object, const char* key) const {
    std::vector<std::size_t> list;
    const GltfJson* const values = gltf_member(object, key);
    if (values == nullptr) return list;
    for (const GltfJson& value : *values) list.push_back(document_.whole_of(value, key));
    return list;
  }

  [[nodiscard]] std::vector<std::size_t> roots() const {
    if (document_.count("scenes") > 0) {
      const std::size_t scene = document_.whole(document_.root(), "scene", 0);
      return numbers(document_.entry("scenes", scene), "nodes");
    }
    const std::size_t count = document_.count("nodes");
    std::vector<char> is_child(count, 0);
    for (std::size_t n = 0; n < count; ++n) {
      for (const std::size_t child : numbers(document_.entry("nodes", n), "children")) {
        if (child < count) is_child[child] = 1;
      }
    }
    std::vector<std::size_t> list;
    for (std::size_t n = 0; n < count; ++n) {
      if (is_child[n] == 0) list.push_back(n);
    }
    if (list.empty() && count > 0) document_.source().fail("its nodes go round in circles");
    return list;
  }

  // So that the first is visited first.
  void push(const std::vector<std::size_t>& nodes, const Placement& parent, bool is_hidden) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      open_.push_back({*node, parent, is_hidden});
    }
  }

  void visit(const Open& open) {
    const GltfJson& node = document_.entry("nodes", open.node);
    if (is_visited_[open.node]++ != 0) {
      document_.source().fail("its nodes are no tree: nodes[" + std::to_string(open.node) +
                              "] is reached twice");
    }
    const Placement placement = placement_of_node(document_, node).then(open.parent);
    const bool is_hidden = open.is_hidden || is_gltf_hidden(node);
    if (const auto mesh = document_.whole(node, "mesh")) {
      add(node, {open.node, *mesh, false, is_hidden, placement});
    }
    push(numbers(node, "children"), placement, is_hidden);
  }

  void add(const GltfJson& node, GltfInstance instance) {
    if (gltf_member(node, "skin") != nullptr) {
      // Joints move such a mesh, its node does not.
      instance.has_skin = true;
      instance.placement = {};
      instances_.push_back(instance);
      return;
    }
    const GltfJson* const extension = gltf_extension(node, "EXT_mesh_gpu_instancing");
    if (extension == nullptr) {
      instances_.push_back(instance);
      return;
    }
    const InstanceList list(document_, buffers_, *extension);
    const Placement placement = instance.placement;
    for (std::size_t i = 0; i < list.count(); ++i) {
      instance.placement = list[i].then(placement);
      instances_.push_back(instance);
    }
  }

  const GltfDocument& document_;
  GltfBuffers& buffers_;
  std::vector<char> is_visited_;
  std::vector<Open> open_;
  std::vector<GltfInstance> instances_;
};

}  // namespace

bool is_gltf_hidden(const GltfJson& node) {
  const GltfJson* const extension = gltf_extension(node, "KHR_node_visibility");
  const GltfJson* const visible =
      extension == nullptr ? nullptr : gltf_member(*extension, "visible");
  return visible != nullptr && visible->is_boolean() && !visible->get<bool>();
}

std::vector<GltfInstance> read_scene(const GltfDocument& document, GltfBuffers& buffers) {
  return SceneReader(document, buffers).run();
}

}  // namespace meshrepair
