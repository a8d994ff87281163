// SPDX-License-Identifier: MIT
// The libraries of two OBJ files as those of one.
#pragma once

#include <memory>

#include <mesh/attributes.h>

#include "material_library.h"

namespace meshrepair {

// Those of attributes that are appended to others, behind those that are there (null: none). A
// material of one name of which both libraries say different things, or of which only one says
// anything though both meshes have it, gets a new name, with all that its library says of it. Null:
// nothing had to change, and there are no others.
[[nodiscard]] std::shared_ptr<const MaterialLibraries> joined_libraries(
    const MaterialLibraries* first, const MaterialLibraries& second, AppendedMaterials& materials);

}  // namespace meshrepair
