// What a ball cannot come to becomes solid.
#pragma once

#include <functional>

#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// The whole repair, of what is not certified once its openings are sealed.
using RepairAgain =
    std::function<Surface(const TriangleSoup&, const RepairOptions&, RepairReport&)>;

// Seals the openings of a solid as `options.seal` says, see seal_openings.h, and brings the report
// of the repair that it came of up to date. A solid without such openings stays as it is. `soup` is
// what was repaired. Throws UsageError where the size is too small for the solid.
[[nodiscard]] Surface seal_solid(const TriangleSoup& soup, Surface solid,
                                 const RepairOptions& options, const RepairAgain& repair_again,
                                 RepairReport& report);

}  // namespace meshrepair::internal
