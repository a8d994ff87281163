// SPDX-License-Identifier: MIT
// What triangles that close a gap carry: it is taken from the rim.
#pragma once

#include <extract/surface.h>
#include <mesh/attributes.h>

namespace meshrepair::internal {

// Fills in the triangles of the surface without a source, patch by patch, of attributes that its
// other triangles have already. See transfer_attributes(). n log n.
void fill_patches(const Surface& surface, Attributes& attributes);

}  // namespace meshrepair::internal
