// SPDX-License-Identifier: MIT
// What the triangles of the input carry, brought onto those of the result.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include <extract/surface.h>
#include <mesh/attributes.h>
#include <mesh/soup.h>
#include <repair/corner_origin.h>
#include <repair/repair_options.h>

namespace meshrepair {

// The material of triangles that close a gap where several charts of a texture meet.
inline constexpr std::string_view kPatchMaterial = "meshrepair_patch";

// Has the repair of the soup with these attributes leave each triangle of the result in one of the
// input, and simplify only as far as attributes change by no more than options.simplify, as a share
// of their extent: sets options.extract and options.reach. Linear.
void keep_attributes(const TriangleSoup& input, const Attributes& attributes,
                     RepairOptions& options);

// By Surface::source. A corner of the result that lies in one of its source triangle has the value
// of that, bit for bit. Any other has the affine function of the source triangle's values at its
// place, found in doubles: right to a few units in the last place, times how much longer than high
// the triangle is. Where simplification moved it from there by d, it is off by at most d times the
// steepness of the function. Normals are of length 1 again, and turn with their triangle. Of
// triangles in one place the first of the input counts that faces as the result does, if there is
// such a one.
//
// Triangles without a source are patches. One whose rim is one chart of the texture has the rim's
// coordinates, and within it those that make each point the mean of its neighbours; and the
// material that most of the rim has. Any other has no coordinates, and kPatchMaterial. Colours and
// other numbers are as coordinates are, whatever the charts. Normals go on with those of the rim,
// and of the patch, but over creases.
//
// Walls of sheets, ThickenOptions, stand off their sources. With `has_walls` a corner has the value
// of the place below it in the plane of its source, and what is nearer to a right angle to that
// than to be parallel has the normals of its own plane.
//
// Where triangles were taken away, `corners` are FewerTrianglesReport::corners, and corners have
// the values of these places; values of whole triangles are those of the source.
//
// Paint of slicers stays on whole triangles, bit for bit, and pieces have that of their place, see
// PaintCode::within(); patches have none.
//
// `attributes` are of `input`, of which `surface` was made. Linear; on several threads.
[[nodiscard]] Attributes transfer_attributes(const TriangleSoup& input,
                                             const Attributes& attributes, const Surface& surface,
                                             bool has_walls = false,
                                             std::span<const CornerOrigin> corners = {});

}  // namespace meshrepair
