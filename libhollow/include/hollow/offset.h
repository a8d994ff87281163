// SPDX-License-Identifier: MIT
// offset() moves the surface of a solid outward or inward by a distance D.
//
// Outward, the result is the solid and all that is at most D from it; inward, what of the solid is
// more than D below its surface. Where OffsetReport::unproven is 0, no point of the new surface is
// nearer to the old one than |D| (1 - kHollowError), and none is farther from it than
// |D| (1 + kHollowError): OffsetReport::least and most bound them, on the coordinates that come
// back. Parts and voids that hold no ball of a radius of |D| (1 + kHollowError) may go.
//
// Outward, convex edges become round, and inward, concave ones. The others stay sharp.
#pragma once

#include <cstddef>

#include <extract/surface.h>
#include <hollow/hollow_options.h>
#include <repair/repair.h>

namespace meshrepair {

struct OffsetReport {
  double distance = 0;       // D, outward if positive; 0: nothing was asked for
  double volume_before = 0;  // of the solid
  double least = 0;          // proven: no point is nearer to the surface before
  double most = 0;           // nor farther from it; infinite if that is not proven
  std::size_t unproven = 0;  // pieces of space for which no proof was found
  std::size_t cells = 0;     // tetrahedra that space was divided into
};

// Of a surface that repair() returned. `options` say how the result is certified, and `report` of
// it is replaced: certificate, topology and sizes. No triangle of the result has a source. Throws
// UsageError for no distance; NoSolidError where nothing is left; ValueError or LimitError where
// the distance is too small beside the solid; Cancelled.
[[nodiscard]] Surface offset(const Surface& solid, double distance, const RepairOptions& options,
                             OffsetReport& made, RepairReport& report);

}  // namespace meshrepair
