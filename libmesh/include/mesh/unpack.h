// What gzip or Zstandard packed. Readers of meshes and points do this themselves.
#pragma once

#include <string>
#include <vector>

#include <base/trivial_vector.h>
#include <mesh/mesh_source.h>
#include <mesh/packing.h>

namespace meshrepair {

// All that comes out of the source, whose options have the observer. What is behind the packed
// bytes but zeros is left out, with a warning. Throws InputError when they are damaged, cut off, or
// hold more than a file of this size should; Cancelled.
[[nodiscard]] TrivialVector<char> unpack(const MeshSource& source, Packing packing,
                                         std::vector<std::string>& warnings);

}  // namespace meshrepair
