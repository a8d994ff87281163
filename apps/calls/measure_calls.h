// SPDX-License-Identifier: MIT
// What is wrong with a mesh, and how far two are apart, as calls.
#pragma once

#include <string>
#include <vector>

#include <check/check_surface.h>
#include <mesh/soup.h>

#include "calls/session.h"

namespace meshrepair {

struct CheckOutcome : Outcome {
  SurfaceCheck check;  // with marks of all triangles
};

// Each throws UsageError for options that are none, before anything runs.

// The outcome is not_certified where the mesh is not the boundary of a solid.
[[nodiscard]] CheckOutcome check_call(const TriangleSoup& soup, const Keywords& keywords,
                                      const Runner& runner);
// The same of a file, with all options of meshcheck, those for further files, too.
[[nodiscard]] Outcome check_file_call(const std::string& input, const Keywords& keywords,
                                      const Runner& runner);
// The report says the distances.
[[nodiscard]] Outcome distance_call(const TriangleSoup& first, const TriangleSoup& second,
                                    const Keywords& keywords, const Runner& runner);

}  // namespace meshrepair
