// SPDX-License-Identifier: MIT
// Meshes that need no cells.
#pragma once

#include <cstddef>
#include <optional>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/certify.h>
#include <repair/orient_parts.h>

namespace meshrepair {

// Why a soup is not valid: the first of these that holds.
enum class Invalid { not_manifold, meets_itself, faces_the_wrong_way };

// The soup as it is, if with its coordinates as they will be written it is the boundary of a solid
// already: closed, manifold, oriented outward, walls of cavities inward, no triangle without area,
// and none that meets another beyond what they share. Points with equal coordinates become one;
// where only points of their own make a manifold of it, they stay, unless the format joins them. It
// has to touch itself along edges as asked for, if it does. Points without triangles go. Exact.
// `progress` is asked whether to go on; it may be null. Else, if `why` is not null, that is set.
// Throws Cancelled.
[[nodiscard]] std::optional<Surface> valid_solid(const TriangleSoup& soup,
                                                 const CertifyOptions& options,
                                                 ProgressObserver* progress,
                                                 Invalid* why = nullptr);

struct MendedSolid {
  Surface surface;
  std::size_t turned_parts = 0;  // that told which way is out, and faced the other way
  std::size_t cavity_walls = 0;  // that did not tell, and are found to be that
};

// The same of a soup that was cleaned, whose holes were closed and whose triangles were turned. The
// parts are turned where that makes such a boundary of it and InsideRule::automatic would do so:
// any that do not tell which way is out, others if none lies in another, or if all are inside out.
// Without `orientation.parts` none is. Not where a part is thinner than a step of the grid.
[[nodiscard]] std::optional<MendedSolid> mended_solid(const CleanSoup& soup,
                                                      const Orientation& orientation,
                                                      const CertifyOptions& options,
                                                      ProgressObserver* progress);

}  // namespace meshrepair
