// SPDX-License-Identifier: MIT
// From a soup to what space is divided by.
#pragma once

#include <base/stage_meter.h>
#include <bsp/clean_soup.h>
#include <mesh/soup.h>
#include <repair/orient_parts.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// On the grid, its holes closed as the options say. Throws NoSolidError when no triangle is left.
[[nodiscard]] CleanSoup close_soup(const TriangleSoup& soup, const RepairOptions& options,
                                   RepairReport& report, StageMeter& meter);

// The same of a surface that is closed and turned rightly already: it stays closed on the grid, and
// there are no holes.
[[nodiscard]] CleanSoup close_surface(const TriangleSoup& mesh, const RepairOptions& options,
                                      RepairReport& report, StageMeter& meter);

// The parts of the soup: oriented for `automatic`, else as they are connected through edges, which
// does not depend on how their triangles are turned. Throws NoSolidError where all triangles lie in
// one plane, which is worth asking first: overlaps in one plane fall into very many pieces.
[[nodiscard]] Orientation orient_soup(const CleanSoup& soup, const RepairOptions& options,
                                      RepairReport& report, StageMeter& meter);

}  // namespace meshrepair::internal
