// SPDX-License-Identifier: MIT
// Puts soups behind each other.
#pragma once

#include <mesh/placement.h>
#include <mesh/soup.h>

namespace meshrepair {

// The points and triangles of `other`, moved to their place, behind those that are there. Where the
// placement mirrors, second and third corners of triangles change places, so that what was outside
// stays outside. Points that are not moved stay as they are, bit for bit. Throws LimitError where
// they are more than a mesh can have.
void append_soup(TriangleSoup& all, const TriangleSoup& other, const Placement& placement = {});

}  // namespace meshrepair
