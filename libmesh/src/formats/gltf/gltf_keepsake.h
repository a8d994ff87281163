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

 private:
  using Key = std::array<std::uint64_t, 3>;
  static Key key_of(std::size_t set, double u, double flipped);

  std::map<Key, float> small_;
};

struct GltfKeepsake final : Keepsake {
  // The document without meshes, skins and buffers. Its nodes have no meshes. Its buffer views have
  // no buffer yet, and are only those that images and animations need.
  GltfJson root;
  std::vector<std::shared_ptr<const std::string>> views;  // the bytes of root["bufferViews"]
  std::vector<std::string> materials;                     // labels of root["materials"]
  GltfSmallV small_v;
};

// `attributes` has the images and the names of the materials. Animations that cannot be kept are
// left out. Throws InputError.
[[nodiscard]] std::shared_ptr<GltfKeepsake> make_gltf_keepsake(const GltfDocument& document,
                                                               GltfBuffers& buffers,
                                                               const Attributes& attributes);

}  // namespace meshrepair
