// What of a result is not where it was given.
#pragma once

#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// Of a surface that was made of corners that sewing moved: takes back that these are points of the
// input, and that their triangles came out as they were.
void note_moved_corners(const TriangleSoup& given, Surface& surface, RepairReport& report);

}  // namespace meshrepair::internal
