// SPDX-License-Identifier: MIT
// What the vertices of a glTF file have besides their positions, as attributes of corners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <base/internal/hash_index.h>
#include <mesh/attributes.h>

#include "gltf_keepsake.h"
#include "gltf_primitive.h"
#include "gltf_scene.h"

namespace meshrepair {

// "JOINTS_0" and "WEIGHTS_0" of a primitive, and so on.
struct GltfSkinSet {
  const GltfAccessor* joints = nullptr;
  const GltfAccessor* weights = nullptr;
};

// "TEXCOORD_0", "NORMAL", "TANGENT", "COLOR_0", "JOINTS_0" with "WEIGHTS_0" and so on as the kind
// `skin`, "_NAME" and morph targets as `other`; what else there may be is left out. Equal values
// have one number.
class GltfValues {
 public:
  // The sets that any of the primitives has.
  explicit GltfValues(const std::vector<const GltfPrimitive*>& primitives);

  // For the triangles of one of them that stands there; its corners are in that order.
  void append(const GltfPrimitive& primitive, const Placement& placement,
              const std::vector<std::uint32_t>& corners);

  // At the end.
  [[nodiscard]] std::vector<CornerAttribute> take_corners();
  [[nodiscard]] GltfSmallV take_small_v() { return std::move(small_v_); }

 private:
  struct Set {
    CornerAttribute attribute;
    internal::HashIndex numbers{0};
  };
  using Key = std::pair<CornerAttribute::Kind, std::pair<std::size_t, std::string>>;

  void fill(const GltfAccessor& accessor, std::uint32_t vertex, const Placement& placement,
            std::size_t set);
  void turn_difference(const Placement& placement, std::string_view semantic);
  void fill_skin(const std::vector<GltfSkinSet>& sets, std::uint32_t vertex,
                 std::size_t components);
  std::uint32_t number_of_value(Set& set);

  std::vector<Set> sets_;
  std::vector<double> value_;  // the one that is read
  GltfSmallV small_v_;
};

}  // namespace meshrepair
