// SPDX-License-Identifier: MIT
#include <cstddef>
#include <vector>

#include <check/edge_contacts.h>

#include "wings.h"

namespace meshrepair {

// Going round an edge, what is behind a forward wing is solid, and what comes after it empty.
EdgeContacts examine_edge_contacts(const TriangleSoup& mesh) {
  const internal::SoupCorners corners(mesh, true);
  const auto visit = [](EdgeContacts& contacts, const std::vector<internal::Wing>& wings) {
    for (std::size_t i = 0; i < wings.size(); ++i) {
      const internal::Wing& next = wings[i + 1 == wings.size() ? 0 : i + 1];
      if (wings[i].edge == next.edge) continue;
      (wings[i].forward ? contacts.joined : contacts.separate) = false;
    }
  };
  const auto join = [](EdgeContacts& all, const EdgeContacts& part) {
    all.joined = all.joined && part.joined;
    all.separate = all.separate && part.separate;
  };
  return internal::SharedEdges(corners).gather<EdgeContacts>(visit, join);
}

}  // namespace meshrepair
