// SPDX-License-Identifier: MIT
// glTF 2.0: .glb with everything in one file, and .gltf, a JSON text that names its buffers.
#pragma once

#include <string>
#include <string_view>

#include <mesh/mesh_source.h>
#include <mesh/reading.h>
#include <mesh/soup_extras.h>

namespace meshrepair {

// `{` and somewhere behind it "asset", or the first bytes of a .glb.
[[nodiscard]] bool is_gltf_text(std::string_view bytes);
[[nodiscard]] bool is_glb(std::string_view bytes);

// The triangles of all nodes of the default scene, in the world's frame: one soup. Corners with
// equal coordinates become one point, as the format splits points where attributes differ. Of files
// named inside only those that buffers lie in are opened. Understood are triangles, strips and
// fans, all accessors, sparse ones too, KHR_mesh_quantization, KHR_draco_mesh_compression,
// EXT_meshopt_compression and EXT_mesh_gpu_instancing. A file that needs another extension is
// refused, unless that is about looks. Morph targets, skins and animations are passed over.
[[nodiscard]] ReadResult read_gltf(const MeshSource& source);

// One mesh, or those of the scene; a primitive for each material. What the file was that the
// attributes came from, if it was glTF, is kept, but for its meshes. Names of image files are made
// relative to the folder. Throws OutputError if a coordinate does not fit into single precision, or
// a .glb would have more than 4 GB.
[[nodiscard]] std::string format_gltf(const TriangleSoup& soup, const SoupExtras& extras,
                                      bool binary);

}  // namespace meshrepair
