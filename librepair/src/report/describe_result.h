// SPDX-License-Identifier: MIT
// What the report says of the surface that a repair ends with.
#pragma once

#include <cstddef>

#include <bsp/clean_soup.h>
#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// RepairReport::triangles and all of `output`. Pre: `parts` is known.
void describe_result(const CleanSoup& input, const Surface& surface, RepairReport& report);

// All of `output` alone.
void describe_output(const Surface& surface, RepairReport& report);

// RepairReport::same_triangles and triangles.rounded, once the surface does not change any more.
void compare_with_input(const TriangleSoup& soup, const Surface& surface, RepairReport& report);

// Of a surface that was made of corners that sewing moved: takes back that these are points of the
// input, and that their triangles came out as they were.
void note_moved_corners(const TriangleSoup& given, Surface& surface, RepairReport& report);

// Triangle t of the surface, which names a source, has its corners, as given or in single
// precision.
[[nodiscard]] bool has_corners_of_source(const TriangleSoup& soup, const Surface& surface,
                                         std::size_t t);

}  // namespace meshrepair::internal
