// SPDX-License-Identifier: MIT
// The edges of a repaired surface at which what its triangles carry changes.
#pragma once

#include <cstdint>
#include <vector>

#include <extract/surface.h>
#include <mesh/attributes.h>

namespace meshrepair::internal {

// DecimationOptions::seams: borders of materials, groups, objects, smoothing groups and paint, and
// around what closes gaps; where texture coordinates jump; creases of normals; and where colours
// and other numbers jump, unless they do so at a quarter of all edges, as those of faces do.
// `carried` are the attributes of the surface. Triangles whose paint is divided have seams all
// around. Empty: there are none.
[[nodiscard]] std::vector<std::uint8_t> find_seams(const Surface& surface,
                                                   const Attributes& carried);

}  // namespace meshrepair::internal
