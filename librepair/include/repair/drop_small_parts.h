// Solids that are too small to be told by the samples of a surface.
#pragma once

#include <cstddef>

#include <extract/surface.h>
#include <repair/repair_report.h>

namespace meshrepair {

// Takes the closed parts, connected through points, that have fewer triangles than this away from a
// surface that repair() made, and brings the report's `output` up to date. Parts that are larger
// stay as they are; where there is none, nothing is taken away. Returns how many parts went.
std::size_t drop_small_parts(Surface& surface, std::size_t fewest, RepairReport& report);

}  // namespace meshrepair
