// SPDX-License-Identifier: MIT
// How far meshes are apart, for people and for scripts.
#pragma once

#include <string>

#include <check/mesh_distance.h>
#include <repair/fidelity.h>

#include "options/command_line.h"
#include "report/json_report.h"

namespace meshrepair {

// How meshdist measures: --samples, --seed, --bound and --bound-factor.
void add_distance_options(CommandLine& app, DistanceOptions& options);

// Mean, RMS and largest distance each way, as they are and as shares of the first mesh's diagonal.
[[nodiscard]] std::string distance_table(const MeshDistance& distance);

// The section "distance" of meshdist's report.
[[nodiscard]] Json distance_section(const MeshDistance& distance, const DistanceOptions& options);

// The section "distance" of meshrepair's report.
[[nodiscard]] Json distance_section(const Fidelity& fidelity);

}  // namespace meshrepair
