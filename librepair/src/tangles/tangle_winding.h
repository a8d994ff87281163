// Winding numbers of the cells around tangles, and of the patches between these.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <base/progress.h>
#include <check/soup_rays.h>
#include <extract/cell_complex.h>
#include <repair/cell_graph.h>
#include <repair/orient_parts.h>

#include "tangles.h"

namespace meshrepair::internal {

// Rays through all of the soup of `tangles`, which outlives them; what they need is made when they
// are first asked for.
class TangleRays {
 public:
  explicit TangleRays(const Tangles& tangles) : tangles_(tangles) {}

  [[nodiscard]] const SoupRays& get();

 private:
  const Tangles& tangles_;
  std::optional<SoupRays> rays_;
};

// A place inside the cell, in grid units; nothing if it is too thin for rounded numbers to tell.
[[nodiscard]] std::optional<Vec3d> place_in(const CellComplex& complex, CellId cell);

struct TangleWinding {
  std::vector<double> of_cell;  // those without links: 0
  // Of each patch, as Tangles::winding turns it; behind it is 1 more.
  std::vector<std::int32_t> in_front;
  // Of each patch, whether cells with links lie on both sides of it somewhere.
  std::vector<char> patch_has_cells;
};

// The graph has no links to cells that were left undivided; `beside` marks the cells next to these.
// Nothing where a place for a ray cannot be told. `progress` is asked whether to go on.
[[nodiscard]] std::optional<TangleWinding> find_tangle_winding(
    const CellComplex& complex, const CellGraph& graph, std::span<const char> beside,
    const Tangles& tangles, const Orientation& orientation, TangleRays& rays,
    ProgressObserver* progress);

// The cells of a list by their volumes, the largest first, as far as these are known: at most so
// many.
[[nodiscard]] std::vector<CellId> largest_cells(const CellGraph& graph,
                                                std::span<const char> beside,
                                                std::vector<CellId> cells, std::size_t most);

}  // namespace meshrepair::internal
