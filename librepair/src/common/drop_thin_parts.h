// SPDX-License-Identifier: MIT
// Taking away parts that are too thin, or that rounding turned inside out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <extract/surface.h>

namespace meshrepair::internal {

// Parts are connected through points. Those whose signed volume has another sign than it had with
// the points `before` go: they are no larger than what the numbers can tell apart. Returns how
// many; 0 too when all would have to go.
std::size_t drop_turned_parts(Surface& surface, const std::vector<Vec3d>& before);

struct InsideOutParts {
  std::size_t dropped = 0;
  std::size_t left = 0;
};

// Parts that face the wrong way, the surface being free of intersections. Moving points by `reach`
// can do this to parts that are thinner, and these go, as do those that face the wrong way then; if
// nothing else is there, they are turned round instead, which is not counted. What is thicker is
// left.
[[nodiscard]] InsideOutParts drop_inside_out_parts(Surface& surface, double reach,
                                                   ProgressObserver* progress);

// Of the parts that one of the triangles `among` belongs to, those go that are no thicker than
// this, on average; none if all parts would go. Returns how many.
std::size_t drop_thin_parts(Surface& surface, std::span<const std::uint32_t> among,
                            double thickness);

// The same of the parts of which no triangle has a flag in `whole`, one for each.
std::size_t drop_thin_crumbs(Surface& surface, const std::vector<char>& whole, double thickness);

}  // namespace meshrepair::internal
