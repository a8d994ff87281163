// Putting together what was cut and what was not.
#pragma once

#include <optional>
#include <vector>

#include <bsp/clean_soup.h>
#include <extract/surface.h>

#include "tangle_labels.h"
#include "tangles.h"

namespace meshrepair::internal {

// The surface of all triangles that are not tangled and have solid on one side, and of `pieces`,
// all that is left of the others: with what the extraction made of the former, as far as it came,
// and by the numbers of the triangles as sources. The result has those of the input. Nothing if the
// edges do not have two triangles each.
[[nodiscard]] std::optional<Surface> sew_pieces(const CleanSoup& soup, const Tangles& tangles,
                                                const std::vector<PatchSides>& sides,
                                                const Surface& pieces);

}  // namespace meshrepair::internal
