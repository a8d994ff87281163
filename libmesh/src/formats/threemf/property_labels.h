// SPDX-License-Identifier: MIT
// What triangles of a 3MF package carry, as attributes of the soup that is made of it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <mesh/attributes.h>

#include "model_instances.h"
#include "model_part.h"

namespace meshrepair {

struct PropertyOddities {
  std::size_t missing = 0;     // triangles whose property is not there
  std::size_t gradients = 0;   // triangles with more than one material
  std::size_t unreadable = 0;  // textures whose picture is not there
};

// A picture of a package, by the part that names it and the path that stands there. Nothing if
// there is none.
using FindPicture =
    std::function<std::optional<Image>(const ModelPart& part, const ModelTexture& texture)>;

// Base materials and textures become materials, colours and coordinates in textures values of
// corners, names of objects labels.
[[nodiscard]] Attributes attributes_of(const std::vector<ModelPart>& parts,
                                       const InstanceResult& placed, const FindPicture& find,
                                       PropertyOddities& oddities);

// The name of a base material that stands for none, where others of the object have one: all
// triangles need one then.
inline constexpr std::string_view kNoMaterialName = "(none)";

}  // namespace meshrepair
