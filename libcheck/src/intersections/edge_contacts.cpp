#include <cstddef>
#include <vector>

#include <check/edge_contacts.h>

#include "wings.h"

namespace meshrepair {

// Going round an edge, what is behind a forward wing is solid, and what comes after it empty.
EdgeContacts examine_edge_contacts(const TriangleSoup& mesh) {
  EdgeContacts contacts;
  const internal::SoupCorners corners(mesh, true);
  internal::SharedEdges(corners).visit([&](const std::vector<internal::Wing>& wings) {
    for (std::size_t i = 0; i < wings.size(); ++i) {
      const internal::Wing& next = wings[i + 1 == wings.size() ? 0 : i + 1];
      if (wings[i].edge == next.edge) continue;
      (wings[i].forward ? contacts.joined : contacts.separate) = false;
    }
  });
  return contacts;
}

}  // namespace meshrepair
