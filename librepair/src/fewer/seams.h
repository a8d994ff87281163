// SPDX-License-Identifier: MIT
// The edges of a repaired surface at which what its triangles carry changes.
#pragma once

#include <cstdint>
#include <vector>

#include <extract/surface.h>
#include <mesh/attributes.h>
#include <simplify/decimate.h>

namespace meshrepair::internal {

struct Seams {
  std::vector<std::uint8_t> sides;             // DecimationOptions::seams; empty: there are none
  std::vector<DecimationOptions::Stay> stays;  // of each point; empty: all may go
};

// Seams: borders of materials, groups, objects, smoothing groups and paint, and
// around what closes gaps; where texture coordinates jump; creases of normals; and where colours
// and other numbers jump, unless they do so at a quarter of all edges, as those of faces do.
// `carried` are the attributes of the surface. Triangles whose paint is divided have seams all
// around. Where values jump at one end of an edge alone, as at the poles of a sphere's texture or
// where a slit in it ends, that end stays alone, and the edge is no seam.
[[nodiscard]] Seams find_seams(const Surface& surface, const Attributes& carried);

}  // namespace meshrepair::internal
