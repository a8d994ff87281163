// What both ways of combining solids do with each of them.
#pragma once

#include <cstddef>
#include <span>

#include <boolean/boolean.h>

namespace meshrepair::internal {

// The grid of all, of which there has to be one; the report gets room for each.
[[nodiscard]] Grid grid_of(std::span<const TriangleSoup> solids, BooleanReport& report);

// On that grid; without triangles where the solid has none. Throws InputError where it is nothing
// there.
[[nodiscard]] CleanSoup clean_operand(const TriangleSoup& solid, std::size_t number,
                                      const Grid& grid, const BooleanOptions& options,
                                      BooleanReport& report);

[[noreturn]] void throw_too_small(std::size_t operand, const Grid& grid);

}  // namespace meshrepair::internal
