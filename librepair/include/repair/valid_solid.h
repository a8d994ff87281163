// Meshes that need no repair.
#pragma once

#include <optional>

#include <bsp/progress.h>
#include <bsp/soup.h>
#include <extract/surface.h>
#include <repair/certify.h>

namespace meshrepair {

// The soup as it is, if with its coordinates as they will be written it is the boundary of a solid
// already: closed, manifold, oriented outward, walls of cavities inward, no triangle without area,
// and none that meets another beyond what they share. Points with equal coordinates become one;
// where only points of their own make a manifold of it, they stay, unless the format joins them. It
// has to touch itself along edges as asked for, if it does. Points without triangles go. Exact.
// `progress` is asked whether to go on; it may be null. Throws Cancelled.
[[nodiscard]] std::optional<Surface> valid_solid(const TriangleSoup& soup,
                                                 const CertifyOptions& options,
                                                 ProgressObserver* progress);

}  // namespace meshrepair
