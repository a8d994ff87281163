// SPDX-License-Identifier: MIT
// Fewer triangles for a repaired surface: what can be asked, and what is told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <mesh/attributes.h>
#include <repair/corner_origin.h>
#include <simplify/decimate.h>

namespace meshrepair {

struct FewerTrianglesOptions {
  std::size_t most = 0;  // triangles of the result, or one fewer; 0: as they come
  double share = 0;      // the same, of the triangles that there were; where `most` is 0

  // How far the surfaces with and without them may be apart, each from the other, anywhere: in the
  // mesh's units; or as a share of the diagonal of its bounding box. 0: as far as it takes.
  double distance = 0;
  bool distance_is_share = false;

  // Of the input: borders of materials, groups, objects and paint, charts of textures, creases of
  // normals and borders of colours stay where they are as well as the surface does. Not owned; may
  // be null.
  const Attributes* attributes = nullptr;

  [[nodiscard]] bool wanted() const { return most > 0 || share > 0 || distance > 0; }
};

struct FewerTrianglesReport {
  bool done = false;                           // the surface was certified, and still is
  std::size_t asked = 0;                       // triangles; 0: as few as the distance allows
  double most_distance = 0;                    // asked for; 0: none was
  bool is_unproven = false;                    // so all triangles stay
  std::size_t before = 0;                      // triangles that there were
  std::size_t after = 0;                       // that are left
  double volume_before = 0, volume_after = 0;  // in the input's units, cubed
  DecimationReport collapses;
  // Of corner k of triangle t of the result at 3 t + k; empty where no values were given.
  std::vector<CornerOrigin> corners;
};

}  // namespace meshrepair
