// SPDX-License-Identifier: MIT
// Which solids of a repaired surface stay.
#pragma once

#include <cstddef>
#include <vector>

#include <base/progress.h>
#include <extract/surface.h>

namespace meshrepair {

struct RepairReport;

// A solid is a shell, connected through points, with the walls of its voids. What lies in such a
// void is another solid. The options are applied in this order.
struct KeepPartsOptions {
  bool outer = false;  // only solids that lie in no void of another one
  // The walls of all voids go, and what is in them; repair() asks for that with Cavities::fill.
  bool fill_voids = false;
  // Only solids of at least this share of the volume of the largest one that is left.
  double smallest_share = 0;
  std::size_t most = 0;  // only so many, those of most volume; 0: all

  [[nodiscard]] bool wanted() const {
    return outer || fill_voids || smallest_share > 0 || most > 0;
  }
};

// A solid with the walls of its voids, or the wall of a void that was filled.
struct RemovedPart {
  bool is_void = false;
  double volume = 0;  // of the solid without its voids, or of the void; in the input's units, cubed
  Vec3d centre = Vec3d::Zero();  // of its bounding box
  std::size_t triangles = 0;
};

struct KeepPartsReport {
  bool asked = false;      // that some go
  bool done = false;       // the surface is closed, and tells what is a solid
  std::size_t solids = 0;  // that there were
  std::size_t voids = 0;
  std::vector<RemovedPart> removed;  // those of more volume first, solids before voids
};

// Takes the other solids away from a surface that repair() made of the input, and brings the report
// up to date. Where the surface is not closed it does not tell what is a solid: nothing is done. n
// log n. Throws Cancelled.
void keep_parts(const TriangleSoup& input, Surface& surface, const KeepPartsOptions& options,
                RepairReport& report, ProgressObserver* progress = nullptr);

// Takes the closed parts, connected through points, that have fewer triangles than this away from a
// surface that repair() made, and brings the report's `output` up to date. Parts that are larger
// stay as they are; where there is none, nothing is taken away. Returns how many parts went.
std::size_t drop_small_parts(Surface& surface, std::size_t fewest, RepairReport& report);

}  // namespace meshrepair
