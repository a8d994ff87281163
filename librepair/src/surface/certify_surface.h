// SPDX-License-Identifier: MIT
// The loop that ends with a certificate, or without one.
#pragma once

#include <optional>

#include <exact/grid.h>
#include <extract/surface.h>
#include <repair/certify.h>
#include <repair/repair_options.h>

#include "simplify_surface.h"

namespace meshrepair::internal {

// The surface as it will be written, closed, manifold, oriented and free of intersections if the
// report says that it passed, else the attempt with the fewest faults. `simpler` is what became of
// it by `simplifier`, if that found anything to leave out.
[[nodiscard]] Surface certify_surface(Surface surface, std::optional<Surface> simpler,
                                      Simplifier& simplifier, const Grid& grid,
                                      const RepairOptions& options, CertifyReport& report);

}  // namespace meshrepair::internal
