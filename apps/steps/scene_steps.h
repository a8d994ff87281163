// SPDX-License-Identifier: MIT
// Scenes whose meshes are taken one by one: what --scene each does.
#pragma once

#include <cstddef>
#include <string>

#include <mesh/scene.h>

#include "program/program.h"
#include "report/findings.h"
#include "steps/point_steps.h"
#include "steps/step_options.h"

namespace meshrepair {

// Throws UsageError where the format has no instances, but the scene needs some.
void check_scene(const Scene& scene, SoupFormat format);

// What a repair that changes nothing gives.
[[nodiscard]] Surface as_given(const TriangleSoup& soup);

// Repairs each mesh by itself, brings the attributes onto them, and writes them with what stands
// where. A mesh that encloses nothing stays as it is, and the output is not certified then; if all
// are such, throws NoSolidError. `repair_options` are of the whole soup. The report gets a section
// "meshes", and the findings their summary. `given` are the attributes of the input that a picture
// shows.
void repair_scene(const AnySoup& input, const Attributes& given,
                  const RepairOptions& repair_options, const WriteOptions& format,
                  const StepOptions& options, Run& run, Findings& findings);

}  // namespace meshrepair
