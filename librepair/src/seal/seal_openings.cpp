// SPDX-License-Identifier: MIT
#include <vector>

#include <repair/seal_openings.h>

#include "bodies_apart.h"
#include "closed_openings.h"

namespace meshrepair {

SealReport propose_seal(const Surface& solid, std::size_t most_cubes, ProgressObserver* progress) {
  SealOptions options;
  options.automatic = true;
  options.most_cubes = most_cubes;
  SealReport report;
  report.automatic = true;
  if (solid.mesh.triangles.empty()) return report;
  const std::vector<Surface> bodies = divide_surface(
      solid, internal::bodies_apart(solid.mesh, 2 * internal::kLargestShareTried, true));
  for (const Surface& body : bodies) {
    SealReport more;
    (void)internal::close_openings(body, options, {bodies.size(), 0}, more, progress);
    internal::add_seal(more, report);
  }
  return report;
}

}  // namespace meshrepair
