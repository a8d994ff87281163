// SPDX-License-Identifier: MIT
// What holds for every file that is read with all that triangles carry, and mesh by mesh.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <base/error.h>
#include <mesh/soup_io.h>

#include "check_reading.h"

namespace meshrepair::testing {

// Readers of instances and components make many triangles of few bytes.
inline constexpr std::size_t kMostTriangles = 20000;

inline void require_complete(const Attributes& attributes, std::size_t triangles) {
  for (const CornerAttribute& set : attributes.corners) {
    require(set.of_corner.size() == 3 * triangles, "corners are missing");
    require(set.values.size() % set.components == 0, "a value has too few numbers");
    for (const std::uint32_t value : set.of_corner) {
      require(value == kNone || value < set.count(), "a value is missing");
    }
  }
  for (const TriangleLabels* labels :
       {&attributes.materials, &attributes.groups, &attributes.objects, &attributes.smoothing}) {
    require(labels->empty() || labels->of_triangle.size() == triangles, "labels are missing");
    for (const std::uint32_t label : labels->of_triangle) {
      require(label == kNone || label < labels->names.size(), "a name is missing");
    }
  }
  for (const TrianglePaint& paint : attributes.paints) {
    require(paint.codes.of_triangle.size() == triangles, "paint is missing");
    for (const std::uint32_t code : paint.codes.of_triangle) {
      require(code == kNone || code < paint.codes.names.size(), "a code is missing");
    }
  }
  require(attributes.looks.empty() || attributes.looks.size() == attributes.materials.names.size(),
          "looks are missing");
  for (const Material& look : attributes.looks) {
    require(look.image == kNone || look.image < attributes.images.size(), "a picture is missing");
  }
}

inline void require_whole_scene(const ReadResult& read) {
  std::size_t points = 0, triangles = 0;
  for (const SceneMesh& mesh : read.scene.meshes) {
    for (std::size_t t = triangles; t < triangles + mesh.triangles; ++t) {
      for (const std::uint32_t corner : read.soup.triangles.at(t)) {
        require(corner >= points && corner < points + mesh.points, "meshes share points");
      }
    }
    points += mesh.points;
    triangles += mesh.triangles;
  }
  require(points == read.soup.points.size() && triangles == read.soup.triangles.size(),
          "meshes are not the soup");
  for (const SceneInstance& instance : read.scene.instances) {
    require(instance.mesh < read.scene.meshes.size(), "an instance is of no mesh");
  }
}

// What was read is written in this format, and read again.
inline void require_comes_back(const ReadResult& read, SoupFormat format, ReadOptions options) {
  SoupExtras extras;
  extras.comments = {"comment"};
  const Attributes held = held_by(format, read.attributes, options.by_mesh);
  extras.attributes = &held;
  if (options.by_mesh) extras.scene = &read.scene;
  std::string written;
  try {
    written = format_soup(read.soup, format, extras);
  } catch (const OutputError& error) {  // numbers that it has no room for
    require_one_line(error.what());
    return;
  }
  options.may_be_empty = true;
  const ReadResult back = read_soup(std::string_view(written), "back", options);
  require(back.soup.triangles.size() == read.soup.triangles.size(), "triangles are lost");
  require_complete(back.attributes, back.soup.triangles.size());
}

// Any bytes are a soup with attributes, or one line that says why not.
inline void check_attributes(std::string_view bytes, const std::string& name, SoupFormat own) {
  for (const bool by_mesh : {false, true}) {
    ReadOptions options;
    options.attributes = true;
    options.by_mesh = by_mesh;
    options.max_triangles = kMostTriangles;
    ReadResult read;
    try {
      read = read_soup(bytes, name, options);
    } catch (const LimitError& error) {
      require_one_line(error.what());
      return;
    } catch (const InputError& error) {
      require_one_line(error.what());
      return;
    }
    require_valid_indices(read.soup);
    require_complete(read.attributes, read.soup.triangles.size());
    if (by_mesh) require_whole_scene(read);
    options.max_triangles = std::numeric_limits<std::size_t>::max();
    require_comes_back(read, own, options);
    require_comes_back(read, SoupFormat::stl_ascii, options);
    if (own != SoupFormat::glb) require_comes_back(read, SoupFormat::glb, options);
    if (own != SoupFormat::ply_binary) require_comes_back(read, SoupFormat::ply_binary, options);
  }
}

}  // namespace meshrepair::testing
