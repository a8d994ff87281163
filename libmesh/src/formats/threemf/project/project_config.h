// SPDX-License-Identifier: MIT
// What slicers' projects say of objects and their volumes, in a part of the package beside the
// model: Metadata/Slic3r_PE_model.config of PrusaSlicer and SuperSlicer names triangles of a mesh,
//
//   <config><object id="1"><metadata type="object" key="name" value="lid"/>
//     <volume firstid="0" lastid="11"><metadata type="volume" key="volume_type" value="ModelPart"/>
//
// Metadata/model_settings.config of Bambu Studio and OrcaSlicer names objects that are components:
//
//   <config><object id="3"><metadata key="name" value="lid"/>
//     <part id="1" subtype="negative_part"><metadata key="name" value="cut"/>
//   <plate><model_instance><metadata key="object_id" value="3"/>
//   <assemble><assemble_item object_id="3"/>
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <base/ids.h>
#include <mesh/mesh_source.h>
#include <mesh/model_volume.h>

namespace meshrepair {

struct ProjectVolume {
  VolumeRole role = VolumeRole::model;
  std::string unknown_role;  // what stands there, where it is none that is known
  std::string name;
  std::uint32_t part = kNone;                 // the object that it is
  std::uint32_t first = kNone, last = kNone;  // or its triangles in the mesh of its object
};

struct ProjectObject {
  std::uint32_t id = kNone;
  std::string name;
  std::vector<ProjectVolume> volumes;
  std::unordered_map<std::uint32_t, std::uint32_t> volume_of_part = {};  // the first one

  // The volume that a mesh is, the k-th of those in the object, by its id; kNone: none. One mesh
  // may be several volumes.
  [[nodiscard]] std::uint32_t volume_of(std::size_t k, std::uint32_t mesh) const;
};

// What became of a volume and an object, for the same list as before.
struct WrittenVolume {
  bool is_there = false;
  std::uint32_t part = kNone;  // kNone: as it was
  std::size_t first = 0;       // triangle of the mesh of its object
  std::size_t triangles = 0;
};

struct WrittenObject {
  std::uint32_t id = kNone;  // kNone: it is not there any more
  std::size_t triangles = 0;
  std::vector<WrittenVolume> volumes;
};

class ProjectConfig {
 public:
  // Throws InputError where it cannot be read. `part` is its name.
  ProjectConfig(const MeshSource& source, const std::string& part,
                std::shared_ptr<const std::string> bytes);

  [[nodiscard]] const std::vector<ProjectObject>& objects() const { return objects_; }

  // The same text, byte for byte, but for numbers of objects and triangles, for what is not there
  // any more, and for files that `has_part` does not know. One entry for each of objects().
  template <class HasPart>
  [[nodiscard]] std::string written(const std::vector<WrittenObject>& now,
                                    const HasPart& has_part) const {
    std::string text;
    std::size_t done = 0;
    for (const Spot& spot : spots_) {
      if (spot.at < done) continue;  // in what is left out
      text.append(*bytes_, done, spot.at - done);
      done = spot.at + append_spot(spot, now, has_part(spot.value), text);
    }
    return text.append(*bytes_, done);
  }

  // A place in the text that may change: a value, or an element.
  struct Spot {
    enum class Kind : std::uint8_t {
      object,     // the element
      volume,     // the same
      instance,   // an element that is nothing without its object
      object_id,  // values
      part_id,
      first,
      last,
      object_faces,
      volume_faces,
      file,
    };

    std::size_t at = 0, size = 0;
    Kind kind = Kind::object;
    std::uint32_t object = 0;  // of objects()
    std::uint32_t volume = 0;  // of it
    std::string value = {};    // of files alone
  };

 private:
  // Returns how many bytes of the text before are done with.
  [[nodiscard]] std::size_t append_spot(const Spot& spot, const std::vector<WrittenObject>& now,
                                        bool is_part, std::string& text) const;

  std::shared_ptr<const std::string> bytes_;
  std::vector<ProjectObject> objects_;
  std::vector<Spot> spots_;  // by their places, elements before what is in them
};

// By the key of its name, see part_key().
[[nodiscard]] bool is_project_config(std::string_view key);

}  // namespace meshrepair
