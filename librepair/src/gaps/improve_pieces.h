// Triangles of a flat region become less thin.
#pragma once

#include <vector>

#include <mesh/edge_table.h>

#include "flat_points.h"

namespace meshrepair::internal {

// Flips edges inside the region, which turns to the left as seen so, where the thinner one of the
// two triangles gets less thin: one that is flat, its corners in a line, goes, unless its longest
// side bounds the region.
void improve_pieces(const FlatPoints& at, std::vector<IndexTriangle>& pieces);

}  // namespace meshrepair::internal
