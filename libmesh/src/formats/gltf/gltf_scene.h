// Where the meshes of a glTF file stand.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <mesh/soup.h>

#include "gltf_buffers.h"
#include "gltf_document.h"

namespace meshrepair {

// From a node's frame to the world's.
struct GltfPlacement {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vec3d offset = Vec3d::Zero();

  [[nodiscard]] bool is_identity() const;
  [[nodiscard]] Vec3d apply(const Vec3d& point) const;
};

struct GltfInstance {
  std::size_t node = 0;
  std::size_t mesh = 0;
  GltfPlacement placement;
};

struct GltfScene {
  std::vector<GltfInstance> instances;  // parents before children, children in their order
  bool has_skins = false;               // meshes with a skin stand where they are without joints
};

// Of the default scene; else of the first; else of all nodes without parents. Throws InputError if
// nodes are missing or no tree.
[[nodiscard]] GltfScene read_scene(const GltfDocument& document, GltfBuffers& buffers);

}  // namespace meshrepair
