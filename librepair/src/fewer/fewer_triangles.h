// SPDX-License-Identifier: MIT
// Takes triangles away from the boundary of a solid, as many as were asked for.
#pragma once

#include <extract/surface.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// Stage "fewer". The surface was made of `input`. Where the surface is not certified, it stays as
// it is. Brings the report up to date. Throws Cancelled; InternalError where what comes out is not
// the boundary of a solid.
void take_triangles_away(const TriangleSoup& input, Surface& surface, const RepairOptions& options,
                         RepairReport& report);

}  // namespace meshrepair::internal
