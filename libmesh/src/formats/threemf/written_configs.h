// SPDX-License-Identifier: MIT
// What a slicer's project says of objects, for those that are written.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <mesh/scene.h>

#include "kept_parts.h"

namespace meshrepair {

// The text of one of kept.configs. `ids` has the new id of each object of the graph, or kNone for
// one that is not written; `scene` the meshes of the graph as they are now.
[[nodiscard]] std::string written_config(const KeptPackage& kept, const ProjectConfig& config,
                                         const std::vector<std::uint32_t>& ids, const Scene& scene);

}  // namespace meshrepair
