// SPDX-License-Identifier: MIT
// hollow() makes cavities in a solid, so that walls of a given thickness are left of it.
//
// A cavity is a connected part of { x inside the solid : the distance of x from the surface is
// above T }. The distance is that to any part of the surface, so voids that are there already get
// walls, too. Where HollowReport::unproven is 0,
//
//  1. no point of a wall's inner side is nearer to the surface than T (1 - kHollowError), and none
//     is farther from it than T (1 + kHollowError): HollowReport::least and most bound them, on
//     the coordinates that come back. Where a drain is drilled, there is no inner side: see below;
//  2. all that is deeper than T (1 + kHollowError) is in a cavity, or counted as left full.
//
// A drain is a prism around a cylinder. HollowReport::beside_drains bounds from below how far
// drains are from each other, and from all of the surface but that around their mouths: what the
// drill comes through, which faces it, with relief of less than a quarter of the wall, and what is
// before it. It is at least T (1 - kHollowError) wherever drains could be placed so. A drain ends
// where its whole section has just got through the wall.
//
// The surface of the solid stays bit for bit, but for the mouths of drains.
#pragma once

#include <extract/surface.h>
#include <hollow/hollow_options.h>
#include <hollow/hollow_report.h>
#include <repair/repair.h>

namespace meshrepair {

// Of a surface that repair() returned. `options` say how the result is certified, and `report` of
// it is replaced: certificate, topology and sizes. Sources of the result are triangles of `solid`;
// walls have none. The solid itself where there is no cavity. Throws UsageError for options out of
// range, ValueError where no drain fits, LimitError where the wall is too thin beside the solid,
// Cancelled.
[[nodiscard]] Surface hollow(const Surface& solid, const HollowOptions& hollow,
                             const RepairOptions& options, HollowReport& hollowed,
                             RepairReport& report);

}  // namespace meshrepair
