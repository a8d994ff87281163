// SPDX-License-Identifier: MIT
// Leaving out the corners that only cutting made.
#pragma once

#include <optional>
#include <vector>

#include <extract/simplify_cuts.h>
#include <extract/surface.h>
#include <repair/repair_options.h>

namespace meshrepair::internal {

// Holds which points stay from one simplification to the next of the same surface, whose points
// were moved in between. Adds to the report each time.
class Simplifier {
 public:
  Simplifier(const RepairOptions& options, SimplifyReport& report)
      : options_(options), report_(report) {}

  // What was never cut is to stay as it was: the points of triangles with a flag in `whole`.
  void keep_points_of(const Surface& surface, const std::vector<char>& whole);

  // Nothing where no point can go; points that would make triangles meet stay from then on.
  [[nodiscard]] std::optional<Surface> simplified(const Surface& surface);

 private:
  const RepairOptions& options_;
  SimplifyReport& report_;
  std::vector<char> stays_;  // of each point
};

}  // namespace meshrepair::internal
