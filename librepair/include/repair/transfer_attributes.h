// What the triangles of the input carry, brought onto those of the result.
#pragma once

#include <cstddef>
#include <string_view>

#include <extract/surface.h>
#include <mesh/attributes.h>
#include <mesh/soup.h>

namespace meshrepair {

// The material of triangles that close a gap, where others have materials.
inline constexpr std::string_view kPatchMaterial = "meshrepair_patch";

// By Surface::source. A corner of the result that lies in one of its source triangle has the value
// of that, bit for bit. Any other has the affine function of the source triangle's values at its
// place, found in doubles: right to a few units in the last place where it is in the triangle's
// plane. Where simplification moved it from there by d, it is off by at most d times the steepness
// of the function. Normals are of length 1 again, and turn with their triangle. Triangles without a
// source have no values, no groups, and kPatchMaterial.
//
// `attributes` are of `input`, of which `surface` was made. Linear; on several threads.
[[nodiscard]] Attributes transfer_attributes(const TriangleSoup& input,
                                             const Attributes& attributes, const Surface& surface);

}  // namespace meshrepair
