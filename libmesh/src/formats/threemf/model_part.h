// SPDX-License-Identifier: MIT
// What a 3D model part of a 3MF package says, as it says it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <base/ids.h>
#include <mesh/length_unit.h>
#include <mesh/model_volume.h>
#include <mesh/placement.h>
#include <mesh/soup.h>

#include "project/project_config.h"

namespace meshrepair {

// Of a triangle or an object: which entry of which group its corners have.
struct PropertyUse {
  std::uint32_t group = kNone;  // its id; kNone: that of the object
  std::array<std::uint32_t, 3> index = {kNone, kNone, kNone};
  std::uint32_t paint = kNone;  // of triangles: a number of ModelPart::painted
};

// Attributes of triangles that slicers paint: as they are read, and as they are written.
struct PaintName {
  std::string_view read, written;
};

inline constexpr std::string_view kPrusaSpace = "http://schemas.slic3r.org/3mf/2017/06";
inline constexpr std::string_view kPrusaPrefix = "slic3rpe";
inline constexpr std::array<PaintName, 8> kPaintNames = {{
    {"paint_color", "paint_color"},
    {"paint_supports", "paint_supports"},
    {"paint_seam", "paint_seam"},
    {"paint_fuzzy_skin", "paint_fuzzy_skin"},
    {"http://schemas.slic3r.org/3mf/2017/06|mmu_segmentation", "slic3rpe:mmu_segmentation"},
    {"http://schemas.slic3r.org/3mf/2017/06|custom_supports", "slic3rpe:custom_supports"},
    {"http://schemas.slic3r.org/3mf/2017/06|custom_seam", "slic3rpe:custom_seam"},
    {"http://schemas.slic3r.org/3mf/2017/06|fuzzy_skin", "slic3rpe:fuzzy_skin"},
}};

// Of a triangle: numbers of ModelPart::codes, by kPaintNames; kNone: no paint.
using PaintCodes = std::array<std::uint32_t, kPaintNames.size()>;

// "Title", "Designer", ...
struct ModelMetadata {
  std::string name, value, preserve, type;
  std::string space = {};  // of the prefix of the name, if it has one

  friend bool operator==(const ModelMetadata&, const ModelMetadata&) = default;
};

// What programs tell objects and copies of them apart by, and say of them; all may be empty.
struct ModelMarks {
  std::string part_number;
  std::string uuid = {};                     // as the production extension has them
  std::string type = {};                     // of objects: "model", ...
  std::string thumbnail = {};                // of objects: a part, as part_name() makes it
  std::string printable = {};                // of items, as slicers have it: "0" or "1"
  std::vector<ModelMetadata> metadata = {};  // of objects and items

  friend bool operator==(const ModelMarks&, const ModelMarks&) = default;
};

// An object of a part, by the number of the part and its own id.
struct ObjectReference {
  std::uint32_t part = 0;
  std::uint32_t object = kNone;
  Placement placement;
  std::shared_ptr<const ModelMarks> marks;  // null: none
};

// Triangles of an object that have a name together: from each first to each last of `ranges`.
struct TriangleSet {
  std::string name;
  std::vector<std::array<std::uint32_t, 2>> ranges;
};

struct ModelObject {
  std::uint32_t id = kNone;
  VolumeRole role = VolumeRole::model;
  std::string name;
  std::shared_ptr<const ModelMarks> marks;  // null: none
  PropertyUse property;                     // of triangles that say nothing
  TriangleSoup mesh;
  std::vector<PropertyUse> properties;         // of the triangles, if asked for
  std::vector<TriangleSet> sets;               // the same
  std::vector<std::uint32_t> set_of_triangle;  // the first; kNone: in none. Empty: there are none
  std::vector<std::uint32_t> bad;              // numbers in the file of triangles that are left out
  std::vector<ObjectReference> components;
  const ProjectObject* project = nullptr;  // what a slicer says of it; null: nothing
  // What split_volumes() made: an object of ranges of its mesh, and of such a range the number of
  // its volume; kNone: of what belongs to none.
  bool is_split = false;
  std::uint32_t volume = kNone;
};

// Entries that triangles refer to by their number.
struct PropertyGroup {
  enum class Kind { base, colour, texture, multi, unknown };

  Kind kind = Kind::unknown;
  std::uint32_t id = kNone;
  std::vector<std::string> names;              // of base materials
  std::vector<std::array<double, 4>> colours;  // of base materials and of colours
  bool has_opacity = false;                    // of a colour at least
  std::uint32_t texture = kNone;               // its id
  std::vector<std::array<double, 2>> points;   // in the texture
  std::vector<std::uint32_t> layers;           // ids of other groups
  std::vector<std::uint32_t> layer_entries;    // as many for each entry as there are layers
};

struct ModelTexture {
  std::uint32_t id = kNone;
  std::string path;
  std::string media_type;
  std::string tile_u, tile_v, filter;  // as they stand there; may be empty
};

// Names of other programs' metadata begin with such a prefix.
struct ModelNamespace {
  std::string prefix, space;
};

struct ModelPart {
  std::string name;  // of the part
  std::optional<LengthUnit> unit;
  std::vector<ModelNamespace> namespaces;
  std::vector<ModelMetadata> metadata;
  std::vector<ModelObject> objects;
  std::unordered_map<std::uint32_t, std::uint32_t> object_of_id;
  std::vector<PropertyGroup> groups;
  std::vector<ModelTexture> textures;
  std::vector<ObjectReference> items;  // of the build
  std::string build_uuid;
  std::vector<std::string> codes;  // of paint, each once
  std::vector<PaintCodes> painted;
};

// Of all parts of a package: what could not be taken.
struct ModelOddities {
  std::size_t bad_triangles = 0;
  std::size_t bad_points = 0;
  std::size_t doubled_ids = 0;
  std::size_t bad_ranges = 0;      // volumes whose triangles are not there, or others' as well
  std::size_t painted = 0;         // triangles with attributes of other programs
  std::size_t unknown_groups = 0;  // compositematerials, and layers beyond those that are read
  std::vector<std::string> unknown_extensions;
  std::set<std::string> unknown_elements;  // the first few, in places that are known
  std::string unknown_unit;
};

}  // namespace meshrepair
