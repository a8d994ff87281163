#include "gltf_nodes.h"

#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>

namespace meshrepair {
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
