// SPDX-License-Identifier: MIT
// Checks of meshes that stand beside each other, as one.
#pragma once

#include <check/check_surface.h>
#include <mesh/placement.h>

namespace meshrepair {

// Behind those that are there: as of one soup whose meshes have nothing to do with each other. Up
// to kMostPagePlaces places of each defect are kept.
void append_check(SurfaceCheck check, SurfaceCheck& all);

// Of a mesh that is checked in its own frame, where it stands. What is wrong with it stays as it
// is; areas are right where all directions are scaled alike.
[[nodiscard]] SurfaceCheck placed_check(SurfaceCheck check, const Placement& placement);

}  // namespace meshrepair
