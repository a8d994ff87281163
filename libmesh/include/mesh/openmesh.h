// SPDX-License-Identifier: MIT
// Adaptor between soups and OpenMesh's half-edge mesh, for programs that use OpenMesh.
#pragma once

#include <filesystem>

#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <mesh/soup.h>

namespace meshrepair {

struct OpenMeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

// Double precision, unlike OpenMesh's default.
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMeshTraits>;

// A mesh with the same points (in order) and faces. OpenMesh cannot hold non-manifold edges: throws
// InputError, naming the first face, when the soup is not a 2-manifold (with or without boundary).
[[nodiscard]] TriMesh to_openmesh(const TriangleSoup& soup);

// Points and faces of any mesh, deleted elements left out.
[[nodiscard]] TriangleSoup from_openmesh(const TriMesh& mesh);

// Reads OpenMesh's own binary format (.om), versions 1 and 2, little endian. Throws InputError for
// a file that is not whole: there is no reading it in part.
[[nodiscard]] TriangleSoup read_om(const std::filesystem::path& path);

}  // namespace meshrepair
