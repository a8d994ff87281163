// SPDX-License-Identifier: MIT
#include "flood.h"

namespace meshrepair::internal {

std::vector<char> flood_from_infinity(const CellGraph& graph, const std::vector<char>& empty,
                                      ProgressObserver* progress) {
  CancelCheck check(progress);
  std::vector<char> inside(graph.cells(), 1);
  std::vector<CellId> queue;
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
    if (!graph.unbounded(c)) continue;
    inside[c.index()] = 0;
    queue.push_back(c);
  }
  while (!queue.empty()) {
    check.tick();
    const CellId cell = queue.back();
    queue.pop_back();
    for (const std::uint32_t l : graph.links_of(cell)) {
      const Link& link = graph.links()[l];
      const CellId next = other_end(link, cell);
      if (link.opaque() || inside[next.index()] == 0 || empty[next.index()] == 0) continue;
      inside[next.index()] = 0;
      queue.push_back(next);
    }
  }
  return inside;
}

}  // namespace meshrepair::internal
