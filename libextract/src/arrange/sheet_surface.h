// SPDX-License-Identifier: MIT
// From the facets that are kept to triangles, as few as their outlines allow.
#pragma once

#include <optional>

#include <base/progress.h>
#include <extract/arrange.h>
#include <extract/surface.h>

#include "kept_facets.h"
#include "sheet_edges.h"

namespace meshrepair::internal {

// Sets report.regions and report.middle_vertices. Nothing if the result is no manifold.
[[nodiscard]] std::optional<Surface> make_sheet_surface(
    const CutSet& cut, const ArrangedPoints& points, const Sheets& sheets, const SheetEdges& edges,
    const KeptFacets& kept, const ExtractOptions& options, ArrangeReport& report);

// Facets between regions, kept as RegionFacets says, merged as above. Points are there once, and
// triangles of several regions meet in corners and whole sides alone.
struct SheetFaces {
  Surface surface;                   // no manifold
  std::vector<std::uint32_t> facet;  // of each triangle one of those that it is made of
};
[[nodiscard]] std::optional<SheetFaces> make_sheet_faces(
    const CutSet& cut, const ArrangedPoints& points, const Sheets& sheets, const SheetEdges& edges,
    const KeptFacets& kept, ProgressObserver* progress);

}  // namespace meshrepair::internal
