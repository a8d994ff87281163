// SPDX-License-Identifier: MIT
// Repairs that need no cells. None of these does anything where RepairOptions::all_cells asks for
// cells; where they give a surface, the report is complete but for its stages.
#pragma once

#include <functional>
#include <optional>

#include <base/stage_meter.h>
#include <bsp/clean_soup.h>
#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/orient_parts.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>
#include <repair/valid_solid.h>

#include "nearly_solid.h"

namespace meshrepair::internal {

// Whether cells may be spared: else they are asked for themselves, or tell more than the surface.
// Where they may, opacity tells nothing: what is solid is a matter of fact.
[[nodiscard]] bool may_spare_cells(const RepairOptions& options);

// The soup, if it is the boundary of a solid; else what `invalid` is set to was found, if it was
// looked for, and `nearly` where triangles meet.
[[nodiscard]] std::optional<Surface> keep_as_given(const TriangleSoup& soup,
                                                   const RepairOptions& options,
                                                   RepairReport& report, StageMeter& meter,
                                                   std::optional<Invalid>& invalid,
                                                   NearlySolid& nearly);

// The clean soup with its holes closed and turned as `orientation` says, if that is one. `invalid`:
// what was found of the soup before; where triangles met and all are as they were, they still do.
[[nodiscard]] std::optional<Surface> keep_mended(const CleanSoup& soup,
                                                 const Orientation& orientation,
                                                 std::optional<Invalid> invalid,
                                                 const RepairOptions& options, RepairReport& report,
                                                 StageMeter& meter);

// May give nothing.
using RepairPlaces =
    std::function<std::optional<Surface>(const TriangleSoup&, const RepairOptions&, RepairReport&)>;

// A large surface that bounds a solid but for a few places where triangles meet: these are repaired
// by `repair_places`, with some rings of triangles around them, all others stay. Nothing
// where there are too many of them, where one cannot be told apart from what is around it, and
// where no certified solid comes of it.
[[nodiscard]] std::optional<Surface> repair_in_places(NearlySolid nearly,
                                                      const RepairOptions& options,
                                                      const RepairPlaces& repair_places,
                                                      RepairReport& report, StageMeter& meter);

// As certification will test it.
[[nodiscard]] CertifyOptions written_as(const RepairOptions& options);

// Solidity fills also what winding numbers leave empty.
[[nodiscard]] bool may_be_kept(const RepairOptions& options);

// Whether voids that are to be filled are parts, as keep_parts() takes them: where a surface
// touches itself, the wall of a void may hang together with what is around it.
[[nodiscard]] bool tells_voids(const Surface& surface, const InsideOptions& options);

}  // namespace meshrepair::internal
