// SPDX-License-Identifier: MIT
// The openings of one body, sealed.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// The whole repair, of what is not certified once its openings are sealed.
using RepairAgain =
    std::function<Surface(const TriangleSoup&, const RepairOptions&, RepairReport&)>;

struct Sealed {
  Surface surface;
  std::vector<char> is_patch;  // of its triangles: over an opening
};

// The body, one of so many, with its openings closed as `options.seal` says, whose size is no
// share; nothing if there are none, or if no solid comes of that (SealReport::cannot_cut). With
// sizes to be found, one after the other, as long as there are more. `report` is that of the body
// alone: of what was closed, and of making the surface.
[[nodiscard]] std::optional<Sealed> seal_body(const Surface& body, std::size_t bodies,
                                              const RepairOptions& options,
                                              const RepairAgain& repair_again,
                                              RepairReport& report);

}  // namespace meshrepair::internal
