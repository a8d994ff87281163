// Triangles in pieces, by the points on their edges and in them.
#pragma once

#include <base/progress.h>
#include <mesh/soup.h>
#include <repair/join_gaps.h>

#include "near_mesh.h"

namespace meshrepair::internal {

// Triangles are cut along edges between points that they have. The report gets what became of
// points.
[[nodiscard]] JoinedSoup cut_near_mesh(const TriangleSoup& soup, const NearMesh& mesh,
                                       JoinGapsReport& report, CancelCheck& check);

}  // namespace meshrepair::internal
