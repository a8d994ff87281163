// SPDX-License-Identifier: MIT
// Files of meshes and points as calls: they are read and written as they are, nothing is repaired.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <mesh/length_unit.h>
#include <mesh/soup.h>

#include "calls/session.h"
#include "steps/point_steps.h"

namespace meshrepair {

struct ReadOutcome : Outcome {
  AnySoup input;
  std::optional<LengthUnit> unit;  // of a mesh, where the file says it
};

// Each throws UsageError for options that are none, before anything runs.

[[nodiscard]] ReadOutcome read_call(const std::string& path, bool attributes,
                                    const Keywords& keywords, const Runner& runner);

// What goes into a file; nothing is owned but the sources.
struct GivenForFile {
  const TriangleSoup* soup = nullptr;
  const Attributes* attributes = nullptr;  // may be null; what the format cannot hold is left out
  std::optional<std::vector<std::uint32_t>> sources;  // one for each triangle
  std::optional<std::string> unit;                    // its name
};

// Throws UsageError, also where there are not as many sources as triangles, or no such unit.
[[nodiscard]] Outcome write_call(const std::string& path, const GivenForFile& given,
                                 const Keywords& keywords, const Runner& runner);

}  // namespace meshrepair
