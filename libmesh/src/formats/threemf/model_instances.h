// SPDX-License-Identifier: MIT
// Puts the instances that a build names into one soup.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <mesh/mesh_source.h>
#include <mesh/model_volume.h>
#include <mesh/scene.h>
#include <mesh/soup.h>

#include "model_part.h"

namespace meshrepair {

// A mesh as it stands in the soup.
struct MeshInstance {
  std::uint32_t part = 0;
  std::uint32_t object = 0;  // its number in the part
  std::uint32_t named = 0;   // of the same part or another: the innermost object around with a name
  std::uint32_t named_part = 0;
  std::size_t first = 0;  // its first triangle; the others follow
  bool turned = false;    // second and third corners have changed places
};

// An object of a build, or a component of an object.
struct KeptReference {
  std::uint32_t object = 0;  // of KeptGraph::objects
  Placement placement;
  std::shared_ptr<const ModelMarks> marks;  // null: none
};

struct KeptObject {
  std::string name;
  std::uint32_t mesh = kNone;  // of the scene, if it has one
  std::vector<KeptReference> components;
  std::shared_ptr<const ModelMarks> marks;  // null: none
  std::uint32_t part = 0, id = kNone;       // in the file
  bool is_split = false;                    // see ModelObject
  std::uint32_t volume = kNone;             // the same
};

// What a build is made of. An object stands behind its components.
struct KeptGraph {
  std::vector<KeptObject> objects;
  std::vector<KeptReference> items;
  std::string build_uuid;
};

struct InstanceResult {
  TriangleSoup soup;
  // If they are asked for mesh by mesh:
  Scene scene;
  KeptGraph graph;
  // Of each part and each of its objects: its number in the scene, or kNone.
  std::vector<std::vector<std::uint32_t>> mesh_of_object;
  // In the soup. Mesh by mesh each stands there once, where it is.
  std::vector<MeshInstance> instances;
  std::size_t missing = 0;  // references to objects that are not there
  // All; none if they are all plain, and no project says anything of them.
  std::vector<ModelVolume> volumes;
  std::vector<PlacedVolume> placed;  // if there are negative volumes to subtract
  bool none_printed = false;         // no item is to be printed: all are taken
};

// Of the items of the first part's build; where there are none, of all its objects that no other
// has as a component. Volumes that are not the model are left out, or not, as ReadOptions says.
// Throws InputError where components name each other in a circle, are nested
// too deep, or make far more triangles than the file holds; LimitError.
[[nodiscard]] InstanceResult place_instances(const MeshSource& source,
                                             const std::vector<ModelPart>& parts);

}  // namespace meshrepair
