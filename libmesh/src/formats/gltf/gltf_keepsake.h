// SPDX-License-Identifier: MIT
// What of a glTF file is no mesh, for another glTF file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mesh/attributes.h>

#include "common/gltf_looks.h"
#include "gltf_buffers.h"
#include "gltf_document.h"

namespace meshrepair {

// glTF's v grows downwards. It becomes 1 - v, and 1 minus that is v again but where v is so small
// that doubles have no room for it. Those few are kept.
class GltfSmallV {
 public:
  // `v` of the file became `flipped`, beside `u`, in the set of texture coordinates of that number.
  void add(std::size_t set, double u, double flipped, float v);
  // As the file had it.
  [[nodiscard]] float original(std::size_t set, double u, double flipped) const;
  // Those of another one that are none here.
  void append(const GltfSmallV& other) { small_.insert(other.small_.begin(), other.small_.end()); }

 private:
  using Key = std::array<std::uint64_t, 3>;
  static Key key_of(std::size_t set, double u, double flipped);

  std::map<Key, float> small_;
};

// What is to be kept.
struct GltfKept {
  bool scene = false;  // which nodes have which meshes
  bool looks = true;   // materials, and what they need
};

// What a mesh has that stands alone for all of its name.
struct GltfObject {
  std::optional<std::size_t> skin;
  GltfJson mesh;  // weights of morph targets, and extras; null: none
};

// The document without meshes and buffers. Its nodes have no meshes unless has_scene; then
// they have them by their numbers in the file. Its buffer views are only those that images,
// animations, skins and instances need.
struct GltfKeepsake final : Keepsake, GltfLooks {
  bool has_scene = false;
  std::vector<GltfJson> meshes;               // if so: what they have besides triangles
  std::map<std::string, GltfObject> objects;  // else, by their names
  std::vector<std::string> materials;         // labels of root["materials"]
  GltfSmallV small_v;
  std::size_t still_channels = 0;  // of animations: what they moved is not kept

  [[nodiscard]] std::vector<std::string> lost_in(SoupFormat format) const override;
  // What the first has, and the materials of this one.
  [[nodiscard]] std::shared_ptr<const Keepsake> appended_to(
      const Keepsake* first, AppendedMaterials& names) const override;

 private:
  [[nodiscard]] std::shared_ptr<GltfKeepsake> copy() const;
  [[nodiscard]] std::shared_ptr<const Keepsake> renamed(AppendedMaterials& names) const;
};

// `attributes` has the images and the names of the materials, if there are to be looks. Animations
// that cannot be kept are left out. Throws InputError.
[[nodiscard]] std::shared_ptr<GltfKeepsake> make_gltf_keepsake(const GltfDocument& document,
                                                               GltfBuffers& buffers,
                                                               const Attributes& attributes,
                                                               GltfKept kept = {});

}  // namespace meshrepair
