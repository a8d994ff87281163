// SPDX-License-Identifier: MIT
// What readers of meshes are asked, and what they return.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <base/progress.h>
#include <base/warning.h>
#include <mesh/attributes.h>
#include <mesh/length_unit.h>
#include <mesh/model_volume.h>
#include <mesh/packing.h>
#include <mesh/scene.h>
#include <mesh/soup.h>
#include <mesh/soup_format.h>

namespace meshrepair {

// Names of other files that a mesh file has, as seen from its folder, once each and sorted.
struct NamesInFile {
  std::vector<std::string> files;     // buffers and libraries; they need not be there
  std::vector<std::string> pictures;  // the same
  std::vector<std::string> outside;   // what they name is never looked for; as the file has them
};

// What a reader passed over. A count of 0 everywhere means that the file was read in full.
struct ReadReport {
  SoupFormat format = SoupFormat::obj;
  std::size_t bytes = 0;                          // unpacked
  std::optional<LengthUnit> unit = std::nullopt;  // of the soup; nothing: the file does not say
  PackedFile packed;
  // What a comment says that was subtracted from all coordinates: see mesh/far_coordinates.h.
  std::optional<Vec3d> offset = std::nullopt;
  std::uint64_t declared_triangles =
      0;                      // faces or triangles that the header promised; 0 if it has none
  std::size_t polygons = 0;   // faces with more than three corners, triangulated
  std::size_t bad_faces = 0;  // faces dropped: index out of range, too few corners, not numbers
  // Points with a coordinate that is no number, or missing: kept as NaN, so that the indices of the
  // others hold. "nan", "inf", "-1.#IND" and the like are numbers: kept as they are, and not
  // counted.
  std::size_t bad_points = 0;
  std::uint64_t missing_faces = 0;  // promised by the header, not in the file
  std::size_t trailing_bytes = 0;   // after the last element of a binary file
  NamesInFile names;
  std::vector<ModelVolume> volumes;  // of a slicer's project; empty: there is only a model
  // One sentence for each kind of oddity, for the user, without the file's name.
  std::vector<Warning> warnings;
};

struct ReadResult {
  TriangleSoup soup;
  Attributes attributes;  // empty unless asked for
  Scene scene;            // the same
  ReadReport report;
  // Of all triangles, if there are negative volumes to subtract.
  std::vector<PlacedVolume> placed = {};
};

struct ReadOptions {
  // More throw LimitError, as soon as it is known; polygons count as what they will become.
  std::size_t max_triangles = std::numeric_limits<std::size_t>::max();
  // Read texture coordinates, normals, colours, materials and groups, too. OBJ and 3MF have them.
  bool attributes = false;
  // Read each mesh in its own frame, and where it stands, as Scene says. Where formats have no such
  // thing, objects are meshes. Without it instances become one soup in the frame of the world.
  bool by_mesh = false;
  // Of slicers' projects; volumes that are neither model nor negative are left out, with a warning.
  // Mesh by mesh all are there, whatever they are.
  NegativeVolumes negative = NegativeVolumes::drop;
  // A file that holds no points and no faces, and promises none, is no error.
  bool may_be_empty = false;
  // Names in the file may lead anywhere in this folder, if the file lies in it. Empty: in that of
  // the file.
  std::filesystem::path within = {};
  ProgressObserver* progress = nullptr;
};

}  // namespace meshrepair
