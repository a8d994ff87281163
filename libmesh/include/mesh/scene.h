// SPDX-License-Identifier: MIT
// The meshes of a file one by one, and where they stand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/placement.h>
#include <mesh/soup.h>

namespace meshrepair {

// Points and triangles of a soup that follow those of the mesh before; no other mesh has them.
struct SceneMesh {
  std::string name;  // may be empty
  std::size_t points = 0;
  std::size_t triangles = 0;
};

struct SceneInstance {
  std::uint32_t mesh = 0;
  std::string name;  // may be empty
  Placement placement;
};

// Of a soup in which meshes stand one after the other, each in its own frame and once. Formats that
// have scenes keep theirs in the keepsake of the attributes, with what instances do not say.
struct Scene {
  std::vector<SceneMesh> meshes;
  std::vector<SceneInstance> instances;
};

// One mesh alone.
[[nodiscard]] std::vector<TriangleSoup> meshes_of(const TriangleSoup& soup, const Scene& scene);

// Makes each object of the attributes a mesh of its own, in the order of their names, and triangles
// without one a mesh at the end: points that several have are doubled, triangles sorted. All stand
// where they are.
[[nodiscard]] Scene split_objects(TriangleSoup& soup, Attributes& attributes);

// Makes one soup of all instances, where they stand; without meshes it stays as it is.
void place_instances(TriangleSoup& soup, Attributes& attributes, const Scene& scene);

// Whether no mesh stands elsewhere than in its own frame, or twice, or not at all.
[[nodiscard]] bool is_plain(const Scene& scene);

}  // namespace meshrepair
