// SPDX-License-Identifier: MIT
// What triangles carry, as a dict of arrays: the texture coordinates, colours and so on of corners,
// and the numbers of names of triangles beside the names.
#pragma once

#include <pybind11/numpy.h>

#include <mesh/attributes.h>
#include <mesh/soup.h>

namespace meshrepair {

// Keys are "texture", "normal", "tangent", "colour", each with the number of the set behind it from
// the second on ("texture_1"), and names of others; values are float64 or float32 as in the file,
// bytes as uint8, integers as int64 if all are there. Shape (points, k), (triangles, k) or
// (triangles, 3, k), the first two where that says all; NaN is none. "material", "group", "object"
// and "smoothing" are int32 of shape (triangles,), -1 for none, into "material_names" and so on.
[[nodiscard]] pybind11::dict dict_of(const Attributes& attributes, const TriangleSoup& soup);

// The way back. Where names of materials are those of `known` (may be null), so is how they look.
// Throws UsageError where an array is none of the above.
[[nodiscard]] Attributes attributes_of(const pybind11::dict& arrays, const TriangleSoup& soup,
                                       const Attributes* known);

}  // namespace meshrepair
