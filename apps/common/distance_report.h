// What meshdist has measured, for people and for scripts.
#pragma once

#include <string>

#include <extract/mesh_distance.h>

#include "common/json_report.h"

namespace meshrepair {

// Mean, RMS and largest distance each way, as they are and as shares of the first mesh's diagonal.
[[nodiscard]] std::string distance_table(const MeshDistance& distance);

// The section "distance" of the report.
[[nodiscard]] Json distance_section(const MeshDistance& distance, const DistanceOptions& options);

}  // namespace meshrepair
