// SPDX-License-Identifier: MIT
// How far the result of a repair is from its input.
#pragma once

#include <cstddef>
#include <optional>

#include <base/progress.h>
#include <check/mesh_distance.h>
#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/certify.h>

namespace meshrepair {

struct FidelityOptions {
  // That the coordinates of the surface were rounded to: areas may differ by as much.
  Precision precision = Precision::float64;
  ProgressObserver* progress = nullptr;  // not owned; no stage is begun
};

struct Fidelity {
  // Large where holes and gaps were closed. Small does not mean that the input is all there.
  OneSidedDistance output_to_input;
  // From the triangles of the input that came out whole; none where no triangle did.
  std::optional<OneSidedDistance> kept_to_output;
  std::size_t kept_triangles = 0;
  double kept_area = 0;  // of these
  double diagonal = 0;   // of the input's bounding box
};

// How many samples are taken of a mesh of so many triangles, besides all its corners: one for each
// triangle, but from 1,000 to 50,000. So it is a small part of what the repair takes.
[[nodiscard]] std::size_t fidelity_samples(std::size_t triangles);

// `surface` is the result of repairing `input`, with the coordinates as they are written; its
// sources are triangles of `input`. An input triangle counts as kept if the triangles that lie in
// it have its area, but for a millionth and what rounding their corners may do: a statistic, on
// which nothing else hangs. Of equal triangles only the first can be. Triangles of the input that
// are not finite are left out. The same for any number of threads. Throws InputError where either
// mesh has no finite triangle, Cancelled.
[[nodiscard]] Fidelity measure_fidelity(const TriangleSoup& input, const Surface& surface,
                                        const FidelityOptions& options = {});

}  // namespace meshrepair
