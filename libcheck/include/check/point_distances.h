// SPDX-License-Identifier: MIT
// How far each of many points is from a mesh: for colours that say so.
#pragma once

#include <span>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair {

// Of each point its distance to the nearest triangle of the mesh that is finite; infinite if it is
// beyond doubles. Pre: the points are finite. `progress` may be null; no stage is begun. The same
// for any number of threads. Throws InputError where no triangle is finite, Cancelled.
[[nodiscard]] std::vector<double> point_distances(std::span<const Vec3d> points,
                                                  const TriangleSoup& mesh,
                                                  ProgressObserver* progress = nullptr);

}  // namespace meshrepair
