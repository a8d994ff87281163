// SPDX-License-Identifier: MIT
// Soups that are boundaries of solids, or closed surfaces at least.
#pragma once

#include <optional>

#include <base/progress.h>
#include <check/self_intersections.h>
#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/certify.h>
#include <repair/valid_solid.h>

namespace meshrepair::internal {

// A soup as it will be written, points in one place joined: each edge has two triangles that pass
// it in opposite directions, and each point one fan.
struct NearlySolid {
  Surface surface;          // without triangles: the soup is no such surface
  SelfIntersections found;  // some of the triangles that meet, or are without area
};

// As valid_solid(); `why` and `nearly` are set where it gives nothing because triangles meet.
[[nodiscard]] std::optional<Surface> solid_as_given(const TriangleSoup& soup,
                                                    const CertifyOptions& options,
                                                    ProgressObserver* progress, Invalid& why,
                                                    NearlySolid& nearly);

// Whether each edge of a mesh has two such triangles, and each point one fan, as valid_solid()
// asks.
[[nodiscard]] bool is_manifold_as_asked(const TriangleSoup& mesh, const CertifyOptions& options);

}  // namespace meshrepair::internal
