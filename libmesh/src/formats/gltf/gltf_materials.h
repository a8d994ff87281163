// The materials and images of a glTF file, as all formats have them.
#pragma once

#include <mesh/attributes.h>

#include "gltf_buffers.h"
#include "gltf_document.h"

namespace meshrepair {

// All of them, in their order: the names of `materials`, one for each, all different; `looks`;
// `images`, of which nothing is decoded. Throws InputError.
void read_materials(const GltfDocument& document, GltfBuffers& buffers, Attributes& attributes);

}  // namespace meshrepair
