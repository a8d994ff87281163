#include <repair/seal_openings.h>

#include "closed_openings.h"

namespace meshrepair {

SealReport propose_seal(const Surface& solid, std::size_t most_cubes, ProgressObserver* progress) {
  SealOptions options;
  options.automatic = true;
  options.most_cubes = most_cubes;
  SealReport report;
  if (!solid.mesh.triangles.empty()) {
    (void)internal::close_openings(solid, options, report, progress);
  }
  return report;
}

}  // namespace meshrepair
