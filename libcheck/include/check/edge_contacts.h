// SPDX-License-Identifier: MIT
// How a surface touches itself along edges.
#pragma once

#include <mesh/soup.h>

namespace meshrepair {

// What its fans of triangles are where several edges lie in one place: each joins the walls of what
// is solid beside the edge, or of what is empty there (cut_nonmanifold.h). Both if nothing touches.
struct EdgeContacts {
  bool separate = true;
  bool joined = true;
};

// Of a closed, oriented 2-manifold; edges of several indices may lie in one place. Where triangles
// meet in more than corners and edges, it says nothing. Exact. n log n.
[[nodiscard]] EdgeContacts examine_edge_contacts(const TriangleSoup& mesh);

}  // namespace meshrepair
